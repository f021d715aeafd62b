//! `stability.html`: every case by every method.

use super::text::{faults, share, word};
use super::{Outcome, Stability, StabilityVerdict};
use crate::report::html::{Html, escape};
use crate::report::number::error;

/// The whole file.
pub fn page(found: &Stability) -> String {
    let mut page = Html::page(&format!("Stiff and extreme cases on {}", found.device));
    page.raw("<div class=\"lead\">\n");
    page.tag("p", &format!("{}.", found.summary()));
    page.raw("</div>\n<dl class=\"facts\">\n");
    page.fact("Device", &format!("{}, {}", found.device, found.driver));
    page.provenance(&found.provenance);
    page.raw("</dl>\n");
    page.tag(
        "p",
        "Each cell is the largest difference of a channel from what is expected, as a share of what is allowed; pixels that \
         f32 or the rasteriser may decide either way are left out. Pictures of methods that end rays early are one and the \
         same, bit for bit.",
    );
    let mut methods: Vec<&str> = found.cases.iter().flat_map(|c| &c.outcomes).map(|o| o.method.as_str()).collect();
    let mut seen = Vec::new();
    methods.retain(|method| {
        let new = !seen.contains(method);
        seen.push(*method);
        new
    });
    let mut groups: Vec<&str> = found.cases.iter().map(|case| case.group.as_str()).collect();
    groups.dedup();
    for group in groups {
        page.raw("<section>\n");
        page.tag("h2", group);
        page.raw("<div class=\"wide\"><table>\n<thead><tr><th>case</th><th>held against</th><th>allowed, and why</th>");
        methods.iter().for_each(|method| page.raw(&format!("<th class=\"number\">{}</th>", escape(method))));
        page.raw("</tr></thead>\n<tbody>\n");
        for case in found.cases.iter().filter(|case| case.group == group) {
            let [absolute, relative] = case.tolerance.map(|t| error(Some(t)));
            let allowed = match case.outcomes.iter().any(|o| o.share.is_some()) {
                true => format!("{absolute} and {relative} of the value: {}", case.reason),
                false => String::new(),
            };
            page.raw(&format!(
                "<tr><td>{}</td><td>{}</td><td>{}</td>",
                escape(&case.name),
                escape(&case.expected),
                escape(&allowed)
            ));
            for method in &methods {
                let outcome = case.outcomes.iter().find(|o| o.method == *method);
                page.raw(&outcome.map_or("<td></td>".to_owned(), cell));
            }
            page.raw("</tr>\n");
        }
        page.raw("</tbody></table></div>\n");
        let wrong: Vec<String> = found
            .cases
            .iter()
            .filter(|case| case.group == group)
            .flat_map(|case| faults(case).into_iter().map(move |fault| format!("{}, {fault}", case.name)))
            .collect();
        if !wrong.is_empty() {
            page.raw("<ul>\n");
            wrong.iter().for_each(|fault| page.tag("li", fault));
            page.raw("</ul>\n");
        }
        page.raw("</section>\n");
    }
    page.closed()
}

fn cell(outcome: &Outcome) -> String {
    let hue = match outcome.verdict {
        StabilityVerdict::Right => "130 45% 80%",
        StabilityVerdict::Wrong => "0 70% 75%",
        StabilityVerdict::Missing => "0 0% 88%",
    };
    let text = match (&outcome.verdict, outcome.share) {
        (StabilityVerdict::Right, Some(share)) => format!("{:.1} %", 100.0 * share),
        (verdict, _) => word(verdict).to_owned(),
    };
    let title = outcome.remark.clone().unwrap_or_else(|| share(outcome.share));
    format!(
        "<td class=\"number\" style=\"background:hsl({hue});color:#000\" title=\"{}\">{}</td>",
        escape(&title),
        escape(&text)
    )
}
