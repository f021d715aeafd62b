//! One scene of the report: pictures, table, plots, plan, settings.

use std::collections::BTreeSet;

use crate::error::Result;
use crate::experiment::orbit::Summary;
use crate::measure::record::{OrbitFrame, PictureRecord, Run};
use crate::report::choice::weighed;
use crate::report::comparison::{self, RunGroup, label_with_form};
use crate::report::cost::Sweep;
use crate::report::growth::Growth;
use crate::report::html::{Html, Pictures, escape};
use crate::report::number::{bytes, milliseconds, thousands};
use crate::report::plot::{changes_svg, cost_svg, fragments_svg, growth_svg, orbit_svg, times_svg};
use crate::report::table::{Column, Table};
use crate::scene::texture::Within;

/// # Errors
/// When a plot cannot be drawn.
pub fn section(
    page: &mut Html,
    group: &RunGroup,
    sweep: Option<&Sweep>,
    records: &[PictureRecord],
    kept: Pictures,
) -> Result<()> {
    page.raw("<section>\n");
    page.tag("h2", &group.first().scene);
    page.raw(&format!("<p class=\"sub\">{}</p>\n", escape(&group.subtitle())));
    warnings(page, group);
    pictures(page, group, records, kept);
    page.table(&comparison::table(group));
    choice(page, group);
    if let Some(svg) = fragments_svg(group)? {
        page.plot(
            &svg,
            &format!("Fragments per pass, {}", group.first().scene),
            "Fragments that passed all tests, pass by pass. Forms of culling that give the same counts in every pass are \
             one line. In long runs the lines take turns in marking a pass: marks of several colours on one line are \
             methods with the same counts there.",
        );
    }
    if let Some(svg) = times_svg(group)? {
        page.plot(
            &svg,
            &format!("Time per method, {}", group.first().scene),
            "Time of a frame. Coloured parts are medians of their own, so their sum need not be the median of the whole, \
             which the black tick marks.",
        );
    }
    if let Some(sweep) = sweep {
        page.plot(
            &cost_svg(sweep)?,
            &format!("Time by the cost of a sample, {}", group.first().scene),
            "Time of a frame in times of rc-ert, where each sample takes so many extra fetches, one after another, which \
             change no picture. Below 1 skipping pays.",
        );
        page.table(&sweep.table());
    }
    if let Some(svg) = orbit_svg(group)? {
        page.plot(
            &svg,
            &format!("Fragments of each frame of an orbit, {}", group.first().scene),
            "Fragments in each frame while the camera goes around the volume. Structures made for a view are built \
             beside the frames, which read omni until one is there that serves their view.",
        );
        orbits(page, group);
    }
    if let Some(svg) = changes_svg(group)? {
        page.plot(
            &svg,
            &format!("Change from frame to frame of an orbit, {}", group.first().scene),
            "How far each picture of the orbit is from the one before, root mean square over pixels and channels. Rings: slices come \
             from another stack of textures, and the picture pops.",
        );
    }
    for (_, run) in &group.runs {
        page.folded(&format!("{}: plan, memory and settings", label_with_form(run)), |page| detail(page, run));
    }
    page.raw("</section>\n");
    Ok(())
}

/// Times of several scenes against what shows in them.
///
/// # Errors
/// When a plot cannot be drawn.
pub fn growth(page: &mut Html, growth: &Growth) -> Result<()> {
    page.raw("<section>\n");
    let of = growth.object.as_ref().map_or_else(String::new, |object| format!(": {object}"));
    page.tag("h2", &format!("Time against what shows{of}"));
    page.plot(
        &growth_svg(growth)?,
        "Time of a frame against the segments that show something",
        "A mark for each scene, which are the same but for their volumes; lines are those of least squares. Where time follows what shows, and not \
         the size of the volume, marks lie on their line. Opacities of an object that is sampled more finely stay what they are by \
         --reference-unit volume.",
    );
    page.table(&growth.table());
    let names: Vec<&str> = growth.scenes.iter().map(|(name, _)| name.as_str()).collect();
    page.tag("p", &format!("Scenes in the order of their segments: {}.", names.join("; ")));
    page.raw("</section>\n");
    Ok(())
}

/// What `auto` chose, and why.
fn choice(page: &mut Html, group: &RunGroup) {
    for auto in group.runs.iter().filter_map(|(_, run)| run.auto.as_ref()) {
        page.list(&auto.sentences());
        page.folded("auto: what was weighed", |page| page.table(&weighed(auto)));
    }
}

/// What may make the pictures mislead, each thing once.
fn warnings(page: &mut Html, group: &RunGroup) {
    let mut said = BTreeSet::new();
    for (_, run) in &group.runs {
        for warning in run.warnings.iter().filter(|warning| said.insert(*warning)) {
            page.raw(&format!("<p class=\"warning\">Warning: {}.</p>\n", escape(warning)));
        }
    }
}

/// The orbit by each method in a line, and frame by frame.
fn orbits(page: &mut Html, group: &RunGroup) {
    for (_, run) in &group.runs {
        let Some(frames) = run.orbit.as_deref() else { continue };
        let Some(summary) = Summary::of(frames) else { continue };
        page.tag("p", &format!("{}: {}.", label_with_form(run), summary.words()));
        page.folded(&format!("{}: frames of the orbit", label_with_form(run)), |page| page.table(&frame_table(frames)));
    }
}

fn frame_table(frames: &[OrbitFrame]) -> Table {
    let (words, numbers) = (Column::words, Column::numbers);
    let mut columns = vec![numbers("frame"), numbers("degrees"), words("structure")];
    columns.extend(["age", "main", "intermediate", "frame ms", "CPU ms", "builds ms"].map(numbers));
    let mut table = Table::new(columns);
    for frame in frames {
        table.row([
            frame.frame.to_string(),
            format!("{:.2}", frame.turned),
            frame.structure.clone().unwrap_or("-".to_owned()),
            frame.age.map_or("-".to_owned(), |age| age.to_string()),
            thousands(frame.main),
            thousands(frame.intermediate),
            milliseconds(frame.frame_ms),
            milliseconds(frame.cpu_ms),
            milliseconds(frame.build_ms),
        ]);
    }
    table
}

fn pictures(page: &mut Html, group: &RunGroup, records: &[PictureRecord], kept: Pictures) {
    page.raw("<div class=\"pictures\">\n");
    for (i, run) in &group.runs {
        let Some(record) = records.iter().find(|record| record.run == *i) else { continue };
        page.raw("<figure>");
        page.picture(kept, &record.file, &format!("{} by {}", run.scene, label_with_form(run)));
        page.raw(&format!("<figcaption>{}", escape(&label_with_form(run))));
        if let Some(difference) = &record.difference {
            page.raw("<br>");
            page.picture(kept, &difference.file, "difference to the reference");
            page.raw(&format!("<br>difference to the reference &#215;&#8201;{}", difference.gain));
        }
        page.raw("</figcaption></figure>\n");
    }
    page.raw("</div>\n");
}

fn detail(page: &mut Html, run: &Run) {
    if !run.notes.is_empty() {
        page.raw("<h4>Notes</h4>\n<ul>");
        for note in &run.notes {
            page.tag("li", note);
        }
        page.raw("</ul>\n");
    }
    page.raw("<h4>Plan</h4>\n");
    page.tag("pre", &run.plan.join("\n"));
    if !run.left_out.is_empty() {
        page.raw("<h4>Left out</h4>\n<dl class=\"facts\">\n");
        for left in &run.left_out {
            page.fact(&left.what, &left.why);
        }
        page.raw("</dl>\n");
    }
    if let Some(error) = &run.error {
        page.raw("<h4>Error</h4>\n<dl class=\"facts\">\n");
        page.fact("Reference", &error.reference);
        page.fact("Largest", &format!("{:e}", error.max));
        page.fact("Root mean square", &format!("{:.3e}", error.rmse));
        let equal = if error.rmse == 0.0 { "infinite: the pictures are equal" } else { "undefined" };
        page.fact("PSNR", &error.psnr.map_or_else(|| equal.to_string(), |db| format!("{db:.1} dB")));
        page.fact("Pixels left out of the largest", &error.undecided.to_string());
        page.raw("</dl>\n");
    }
    if let Some(texture) = &run.texture {
        page.raw("<h4>Volume on the device</h4>\n<dl class=\"facts\">\n");
        page.fact("Kept as", &texture.format);
        page.fact("An interpolated x is off by at most", &Within(texture.x_error).to_string());
        page.fact("A channel of a pixel is off by at most", &Within(texture.pixel_error).to_string());
        page.raw("</dl>\n");
    }
    page.raw("<h4>Memory</h4>\n<dl class=\"facts\">\n");
    page.fact("structures", &bytes(run.bytes));
    for (resource, size) in &run.memory {
        page.fact(resource, &bytes(*size));
    }
    page.raw("</dl>\n<h4>Settings</h4>\n");
    let settings = serde_json::to_string_pretty(&run.settings).unwrap_or_else(|e| format!("not available ({e})"));
    page.tag("pre", &settings);
}
