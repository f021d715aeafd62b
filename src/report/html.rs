//! The pieces that pages are made of, and the one head of all of them. Whatever comes from a run goes through [`escape`].

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::table::{Cell, Column, Table, note_mark};
use crate::provenance::Provenance;

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

/// A picture as a page takes it: the bytes of its PNG file, width and height.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Png {
    pub bytes: Vec<u8>,
    pub size: [u32; 2],
}

/// Where a page finds the pictures that a record names: the picture, or why there is none.
pub type Pictures<'a> = &'a dyn Fn(&str) -> std::result::Result<Png, String>;

/// What stands above the numbers of a page, or of a section with results of its own.
pub struct Intro<'a> {
    /// What it comes to, a sentence or two each.
    pub lead: Vec<String>,
    /// Terms, and what they are, as markup.
    pub facts: Vec<(String, String)>,
    pub made: &'a Provenance,
}

impl<'a> Intro<'a> {
    pub fn new(lead: Vec<String>, made: &'a Provenance) -> Self {
        Self { lead, facts: Vec::new(), made }
    }

    /// Adds a term and what it is.
    pub fn fact(mut self, term: &str, text: &str) -> Self {
        self.facts.push((term.to_owned(), escape(text)));
        self
    }
}

/// A page that grows.
#[derive(Default)]
pub struct Html(String);

impl Html {
    /// A page with its head: title, what it comes to, and where it comes from.
    pub fn page(title: &str, intro: &Intro) -> Self {
        let mut page = Self::default();
        page.raw("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
        page.raw("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
        page.tag("title", title);
        page.raw(&format!("<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n"));
        page.tag("h1", title);
        page.intro(intro);
        page
    }

    pub fn intro(&mut self, intro: &Intro) {
        self.raw("<div class=\"lead\">\n");
        intro.lead.iter().for_each(|sentence| self.tag("p", sentence));
        self.raw("</div>\n<dl class=\"facts\">\n");
        for (term, markup) in &intro.facts {
            self.raw(&format!("<dt>{}</dt><dd>{markup}</dd>\n", escape(term)));
        }
        self.fact("Date", &intro.made.date);
        self.fact("Program", &intro.made.made_by());
        self.raw(&format!("<dt>Command</dt><dd><code>{}</code></dd>\n</dl>\n", escape(&intro.made.command)));
    }

    /// The whole text of a page.
    pub fn closed(mut self) -> String {
        self.raw("</main>\n</body>\n</html>\n");
        self.0
    }

    /// Markup as it is.
    pub fn raw(&mut self, markup: &str) {
        self.0.push_str(markup);
    }

    /// An element with nothing but text in it.
    pub fn tag(&mut self, name: &str, text: &str) {
        self.raw(&format!("<{name}>{}</{name}>\n", escape(text)));
    }

    /// A list with dots; nothing where it is empty.
    pub fn list(&mut self, items: &[String]) {
        if items.is_empty() {
            return;
        }
        self.raw("<ul>\n");
        items.iter().for_each(|item| self.tag("li", item));
        self.raw("</ul>\n");
    }

    /// A term and what it is, within a `dl`.
    pub fn fact(&mut self, term: &str, text: &str) {
        self.raw(&format!("<dt>{}</dt><dd>{}</dd>\n", escape(term), escape(text)));
    }

    /// What is shown when asked for.
    pub fn folded(&mut self, summary: &str, body: impl FnOnce(&mut Self)) {
        self.raw(&format!("<details><summary>{}</summary>\n", escape(summary)));
        body(self);
        self.raw("</details>\n");
    }

    /// The picture of that name within the page, or that it is missing.
    pub fn picture(&mut self, pictures: Pictures, file: &str, alt: &str) {
        match pictures(file) {
            Ok(Png { bytes, size: [width, height] }) => self.raw(&format!(
                "<img src=\"data:image/png;base64,{}\" width=\"{width}\" height=\"{height}\" alt=\"{}\">",
                STANDARD.encode(bytes),
                escape(alt)
            )),
            Err(why) => self.raw(&format!(
                "<span class=\"warning\">The picture {} is missing: {}.</span>",
                escape(file),
                escape(&why)
            )),
        }
    }

    /// A plot within the page, where an SVG needs no name space.
    pub fn plot(&mut self, svg: &str, label: &str, caption: &str) {
        let open = format!("<svg role=\"img\" aria-label=\"{}\"", escape(label));
        let svg = svg.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1).replacen("<svg", &open, 1);
        self.raw(&format!("<figure class=\"plot\">\n{svg}<figcaption>{}</figcaption></figure>\n", escape(caption)));
    }

    /// A table with its footnotes.
    pub fn table(&mut self, table: &Table) {
        self.raw("<div class=\"wide\"><table>\n<thead><tr>");
        for Column { head, right } in &table.columns {
            let head: Vec<String> = head.iter().map(|line| escape(line)).collect();
            self.raw(&format!("<th{}>{}</th>", side(*right), head.join("<br>")));
        }
        self.raw("</tr></thead>\n<tbody>\n");
        for row in &table.rows {
            let across = match row.len() == table.columns.len() {
                true => String::new(),
                false => format!(" colspan=\"{}\"", table.columns.len()),
            };
            let cells = row.iter().zip(&table.columns).map(|(cell, column)| cell_html(cell, column.right, &across));
            self.raw(&format!("<tr>{}</tr>\n", cells.collect::<String>()));
        }
        self.raw("</tbody></table></div>\n");
        if !table.notes.is_empty() {
            self.raw("<ol class=\"notes\">\n");
            table.notes.iter().for_each(|note| self.tag("li", note));
            self.raw("</ol>\n");
        }
    }
}

fn side(right: bool) -> &'static str {
    if right { " class=\"number\"" } else { "" }
}

fn cell_html(cell: &Cell, right: bool, across: &str) -> String {
    let ground = cell.ground.as_ref().map(|hsl| format!(" style=\"background:hsl({hsl});color:#000\""));
    let title = cell.title.as_ref().map(|title| format!(" title=\"{}\"", escape(title)));
    let text = if cell.text == "-" { "–".to_owned() } else { escape(&cell.text) };
    let spread = cell.spread.as_ref().map(|spread| format!("<small>&#177;&#8201;{}</small>", escape(spread)));
    let note = cell.note.map(|n| format!("<sup>{}</sup>", note_mark(n)));
    let [ground, title, spread, note] = [ground, title, spread, note].map(Option::unwrap_or_default);
    format!("<td{}{across}{ground}{title}>{text}{spread}{note}</td>", side(right))
}
