//! The few pieces of HTML the report is made of. Whatever comes from a run goes through [`escape`].

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::error::Result;
use crate::measure::picture::{Format, Picture};
use crate::provenance::Provenance;
use crate::report::comparison::{COLUMNS, Cell, Grid, note_mark};

const STYLE: &str = include_str!("style.css");

/// Text as it may stand in an element or a quoted attribute.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c => out.push(c),
        }
    }
    out
}

/// A page that grows.
#[derive(Default)]
pub struct Html(String);

impl Html {
    /// A page with its heading.
    pub fn page(title: &str) -> Self {
        let mut page = Self::default();
        page.raw("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
        page.raw("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
        page.tag("title", title);
        page.raw(&format!("<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n"));
        page.tag("h1", title);
        page
    }

    /// The whole text of a page.
    pub fn closed(mut self) -> String {
        self.raw("</main>\n</body>\n</html>\n");
        self.0
    }

    /// A table of words, the first column left, the others right.
    pub fn table(&mut self, head: &[&str], rows: &[Vec<String>]) {
        let cell = |i: usize, tag: &str, text: &str| format!("<{tag}{}>{}</{tag}>", side(i > 0), escape(text));
        let row = |tag: &str, cells: &mut dyn Iterator<Item = &str>| {
            let cells: String = cells.enumerate().map(|(i, text)| cell(i, tag, text)).collect();
            format!("<tr>{cells}</tr>")
        };
        let body: Vec<String> = rows.iter().map(|r| row("td", &mut r.iter().map(String::as_str))).collect();
        let head = row("th", &mut head.iter().copied());
        self.raw(&format!(
            "<div class=\"wide\"><table>\n<thead>{head}</thead>\n<tbody>\n{}\n</tbody></table></div>\n",
            body.join("\n")
        ));
    }

    /// Markup as it is.
    pub fn raw(&mut self, markup: &str) {
        self.0.push_str(markup);
    }

    /// An element with nothing but text in it.
    pub fn tag(&mut self, name: &str, text: &str) {
        self.raw(&format!("<{name}>{}</{name}>\n", escape(text)));
    }

    /// A term and what it is, within a `dl`.
    pub fn fact(&mut self, term: &str, text: &str) {
        self.raw(&format!("<dt>{}</dt><dd>{}</dd>\n", escape(term), escape(text)));
    }

    /// The facts of where results come from, within a `dl`.
    pub fn provenance(&mut self, made: &Provenance) {
        self.fact("Date", &made.date);
        self.fact("Program", &made.made_by());
        self.raw(&format!("<dt>Command</dt><dd><code>{}</code></dd>\n", escape(&made.command)));
    }

    /// What is shown when asked for.
    pub fn folded(&mut self, summary: &str, body: impl FnOnce(&mut Self)) {
        self.raw(&format!("<details><summary>{}</summary>\n", escape(summary)));
        body(self);
        self.raw("</details>\n");
    }

    /// A picture within the page, as a PNG over `background` (linear RGB).
    pub fn picture(&mut self, picture: &Picture, background: [f64; 3], alt: &str) -> Result<()> {
        let png = STANDARD.encode(picture.encode(Format::Png, background)?);
        let [width, height] = picture.size;
        let alt = escape(alt);
        self.raw(&format!(
            "<img src=\"data:image/png;base64,{png}\" width=\"{width}\" height=\"{height}\" alt=\"{alt}\">"
        ));
        Ok(())
    }

    /// A plot within the page, where an SVG needs no name space.
    pub fn plot(&mut self, svg: &str, label: &str, caption: &str) {
        let open = format!("<svg role=\"img\" aria-label=\"{}\"", escape(label));
        let svg = svg.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1).replacen("<svg", &open, 1);
        self.raw(&format!("<figure class=\"plot\">\n{svg}<figcaption>{}</figcaption></figure>\n", escape(caption)));
    }

    pub fn grid(&mut self, grid: &Grid) {
        self.raw("<div class=\"wide\"><table>\n<thead><tr>");
        for column in COLUMNS {
            let head = column.head.map(escape).join("<br>");
            self.raw(&format!("<th{}>{head}</th>", side(column.right)));
        }
        self.raw("</tr></thead>\n<tbody>\n");
        for row in &grid.rows {
            self.raw("<tr>");
            for (cell, column) in row.iter().zip(COLUMNS) {
                self.raw(&format!("<td{}>{}</td>", side(column.right), cell_html(cell)));
            }
            self.raw("</tr>\n");
        }
        self.raw("</tbody></table></div>\n<ol class=\"notes\">\n");
        for note in &grid.notes {
            self.tag("li", note);
        }
        self.raw("</ol>\n");
    }
}

fn side(right: bool) -> &'static str {
    if right { " class=\"number\"" } else { "" }
}

fn cell_html(cell: &Cell) -> String {
    let text = if cell.text == "-" { "–".to_string() } else { escape(&cell.text) };
    let mad = cell.mad.as_ref().map(|mad| format!("<small>&#177;&#8201;{}</small>", escape(mad))).unwrap_or_default();
    let note = cell.note.map(|n| format!("<sup>{}</sup>", note_mark(n))).unwrap_or_default();
    format!("{text}{mad}{note}")
}
