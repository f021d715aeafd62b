//! What curves may be held against each other for, so that every one of them can be told apart in a plot.

use super::Curve;
use super::way::Way;
use crate::report::plot::DISTINCT;

/// What the curves of a question differ in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum About {
    Methods,
    /// How samples, and places of surfaces, are found.
    Sampling,
    /// Where gradients come from.
    Gradients,
    /// What voxels and colours are kept in.
    Formats,
    /// Nothing in common.
    Others,
}

/// Curves that answer one question together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Question {
    pub about: About,
    pub title: String,
    /// Places among the curves, each with its label here.
    pub curves: Vec<(usize, String)>,
}

/// What the curves may be held against each other for: the methods, in each way of sampling that several were run in; the
/// ways of sampling; the formats that voxels and colours are kept in; of surfaces the ways to find their places, and those to
/// take gradients. Every curve stands somewhere, and no question has more of them than can be told apart.
pub fn questions(curves: &[Curve]) -> Vec<Question> {
    let mut asked = Vec::new();
    for variation in distinct(curves, |curve| &curve.variation) {
        let title = if variation.is_empty() { "Methods" } else { &format!("Methods, {variation}") };
        ask(&mut asked, (About::Methods, title), curves, |curve| {
            (curve.variation == *variation).then(|| curve.method.clone())
        });
    }
    for method in distinct(curves, |curve| &curve.method) {
        let shown = |i: usize| asked.iter().any(|question| question.curves.iter().any(|(at, _)| *at == i));
        let all_shown = (0..curves.len()).filter(|i| curves[*i].method == *method).all(shown);
        // The first method stands for those that were run in no other ways.
        if !all_shown || curves[0].method == *method {
            let has_surface = curves[0].settings.has_surface();
            if has_surface { surface_ways(&mut asked, curves, method) } else { ways(&mut asked, curves, method) }
        }
    }
    let shown: Vec<usize> = asked.iter().flat_map(|question| question.curves.iter().map(|(i, _)| *i)).collect();
    let others: Vec<(usize, String)> =
        (0..curves.len()).filter(|i| !shown.contains(i)).map(|i| (i, curves[i].name())).collect();
    put(&mut asked, (About::Others, "Others"), &others);
    asked
}

/// The ways of sampling of one method, and the formats it keeps voxels and colours in.
fn ways(asked: &mut Vec<Question>, curves: &[Curve], method: &str) {
    let of = |curve: &Curve| (curve.method == *method).then(|| Way::of(&curve.settings));
    let name = |curve: &Curve| {
        if curve.variation.is_empty() { "as the scene is sampled".to_owned() } else { curve.variation.clone() }
    };
    let Some(own) = curves.iter().find_map(of) else { return };
    let formats = |way: Way| (way.accumulate, way.texture);
    let sampled = |way: Way| Way { accumulate: own.accumulate, texture: own.texture, ..way };
    ask(asked, (About::Sampling, &format!("Ways of sampling, {method}")), curves, |curve| {
        of(curve).filter(|way| formats(*way) == formats(own)).map(|_| name(curve))
    });
    let all: Vec<Way> = curves.iter().filter_map(of).collect();
    let several = |way: Way| all.iter().any(|other| sampled(*other) == sampled(way) && formats(*other) != formats(way));
    let title = format!("Formats of voxels and colours, {method}");
    let title = (About::Formats, title.as_str());
    let kept: Vec<(usize, Way)> =
        curves.iter().enumerate().filter_map(|(i, curve)| Some((i, of(curve).filter(|way| several(*way))?))).collect();
    let labelled = |these: Vec<usize>| these.into_iter().map(|i| (i, name(&curves[i]))).collect::<Vec<_>>();
    if kept.len() <= DISTINCT {
        put(asked, title, &labelled(kept.iter().map(|(i, _)| *i).collect()));
        return;
    }
    let mut done: Vec<Way> = Vec::new();
    for (_, way) in &kept {
        if !done.contains(&sampled(*way)) {
            done.push(sampled(*way));
            let these = kept.iter().filter(|(_, other)| sampled(*other) == sampled(*way)).map(|(i, _)| *i);
            put(asked, title, &labelled(these.collect()));
        }
    }
}

/// The ways of one method to find the places of a surface, with the gradients that the scene asks for; and those to take gradients,
/// at places that are found alike.
fn surface_ways(asked: &mut Vec<Question>, curves: &[Curve], method: &str) {
    let of = |curve: &Curve| (curve.method == *method).then(|| Way::of(&curve.settings));
    let all: Vec<Way> = curves.iter().filter_map(of).collect();
    let Some(own) = all.first().copied() else { return };
    let label = |way: Way, words: String| if way == own { format!("{words} (the scene's own)") } else { words };
    let places = format!("Ways to find a place, {method}");
    ask(asked, (About::Sampling, &places), curves, |curve| {
        let way = of(curve).filter(|way| way.gradient == own.gradient)?;
        Some(label(way, format!("{}, {}", way.refined(), way.filtered())))
    });
    let found = |way: Way| (way.refine, way.filter);
    let Some(other) = all.iter().find(|way| way.gradient != own.gradient) else { return };
    let gradients = format!("Gradients, {}, {method}", other.refined());
    ask(asked, (About::Gradients, &gradients), curves, |curve| {
        let way = of(curve).filter(|way| found(*way) == found(*other))?;
        Some(label(way, way.gradient.words()))
    });
}

/// Asks a question of the curves that have a label for it, where there are several.
fn ask(asked: &mut Vec<Question>, title: (About, &str), curves: &[Curve], label: impl Fn(&Curve) -> Option<String>) {
    let found: Vec<(usize, String)> =
        curves.iter().enumerate().filter_map(|(i, curve)| Some((i, label(curve)?))).collect();
    if found.len() > 1 {
        put(asked, title, &found);
    }
}

/// Puts a question, in as many parts as it needs.
fn put(asked: &mut Vec<Question>, (about, title): (About, &str), curves: &[(usize, String)]) {
    let parts = curves.chunks(DISTINCT);
    let several = parts.len() > 1;
    for (i, part) in parts.enumerate() {
        let title = if several { format!("{title} ({})", i + 1) } else { title.to_owned() };
        asked.push(Question { about, title, curves: part.to_vec() });
    }
}

/// The values of a field in the order of their first curves.
fn distinct<'a>(curves: &'a [Curve], of: impl Fn(&'a Curve) -> &'a String) -> Vec<&'a String> {
    let mut values: Vec<&String> = Vec::new();
    for value in curves.iter().map(of) {
        if !values.contains(&value) {
            values.push(value);
        }
    }
    values
}
