//! The one table: as text, as CSV and in a page.

use depthleap::provenance::Provenance;
use depthleap::report::html::{Html, Intro};
use depthleap::report::table::{Cell, Column, Table, TextLayout};

fn table() -> Table {
    let mut table =
        Table::new(vec![Column::words("name"), Column { head: vec!["upper".into(), "low".into()], right: true }]);
    table.row(["a<b>", "1,000"]);
    let ground = Some("130 45% 80%".to_owned());
    table.row([
        Cell::from("longer"),
        Cell { note: Some(0), spread: Some("0.5".into()), ground, title: Some("\"why\"".into()), ..Cell::from("2") },
    ]);
    table.row(["across all"]);
    table.notes.push("a note".into());
    table
}

#[test]
fn text_stands_in_columns() {
    let expected =
        "name        upper\n              low\na<b>    1,000    \nlonger      2 (a)\nacross all\n(a) a note\n";
    let trimmed: Vec<&str> = expected.lines().map(str::trim_end).collect();
    assert_eq!(table().text(&TextLayout::default()).lines().collect::<Vec<_>>(), trimmed);
    let wide = table().text(&TextLayout { indent: 2, gap: 1, least: vec![8, 12], rule: true });
    assert_eq!(wide.lines().next().unwrap(), "  name            upper");
    assert_eq!(wide.lines().nth(2).unwrap(), format!("  {}", "-".repeat(21)));
}

#[test]
fn csv_is_read_again() {
    let mut table = Table::new(["a", "b,c"].map(Column::words).to_vec());
    table.row(["1", "with \"quotes\", and\nlines"]);
    let text = table.csv().unwrap();
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    assert_eq!(reader.headers().unwrap(), vec!["a", "b,c"]);
    assert_eq!(&reader.records().next().unwrap().unwrap()[1], "with \"quotes\", and\nlines");
}

#[test]
fn page_escapes_cells_and_shows_notes() {
    let made = Provenance {
        version: 1,
        program: "<p>".into(),
        commit: "c".into(),
        command: "run <x>".into(),
        date: "today".into(),
    };
    let intro = Intro::new(vec!["lead & more".into()], &made).fact("term", "<fact>");
    let mut page = Html::page("title <t>", &intro);
    page.table(&table());
    let page = page.closed();
    for part in [
        "<h1>title &lt;t&gt;</h1>",
        "lead &amp; more",
        "&lt;fact&gt;",
        "<code>run &lt;x&gt;</code>",
        "a&lt;b&gt;",
        "<th class=\"number\">upper<br>low</th>",
        "background:hsl(130 45% 80%)",
        "title=\"&quot;why&quot;\"",
        "<small>&#177;&#8201;0.5</small><sup>a</sup>",
        "colspan=\"2\"",
        "<li>a note</li>",
    ] {
        assert!(page.contains(part), "{part} is not in\n{page}");
    }
}
