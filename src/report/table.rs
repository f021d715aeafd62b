//! The one table: rows under columns, as text for a terminal, as CSV for a spreadsheet; a page takes it as it is
//! ([`Html::table`](super::html::Html::table)).

use std::fmt::Write;

use crate::error::{Error, Result};

/// A column: the lines of its heading, and on which side its cells stand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    pub head: Vec<String>,
    /// Numbers stand right, words left.
    pub right: bool,
}

impl Column {
    /// A column of words.
    pub fn words(head: impl Into<String>) -> Self {
        Self { head: vec![head.into()], right: false }
    }

    /// A column of numbers.
    pub fn numbers(head: impl Into<String>) -> Self {
        Self { head: vec![head.into()], right: true }
    }
}

/// What stands in a row under a column.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cell {
    pub text: String,
    /// Spread beside a median; pages show it.
    pub spread: Option<String>,
    /// Place of the footnote among the table's.
    pub note: Option<usize>,
    /// Hue, saturation and lightness of its ground in a page, as CSS has them.
    pub ground: Option<String>,
    /// What a page says where the pointer rests.
    pub title: Option<String>,
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self { text: text.into(), ..Self::default() }
    }
}

/// Rows under columns. A row with fewer cells than columns stands across all of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    pub columns: Vec<Column>,
    pub rows: Vec<Vec<Cell>>,
    /// What the marks `(a)`, `(b)`, ... stand for.
    pub notes: Vec<String>,
}

/// How a table stands in a text.
#[derive(Clone, Debug)]
pub struct TextLayout {
    /// Spaces in front of each line.
    pub indent: usize,
    /// Spaces between columns.
    pub gap: usize,
    /// Columns are at least so wide, so that several tables stand alike.
    pub least: Vec<usize>,
    /// A rule below the heading.
    pub rule: bool,
}

impl Default for TextLayout {
    fn default() -> Self {
        Self { indent: 0, gap: 2, least: Vec::new(), rule: false }
    }
}

impl Table {
    /// A table without rows.
    pub fn new(columns: Vec<Column>) -> Self {
        Self { columns, ..Self::default() }
    }

    pub fn row<C: Into<Cell>>(&mut self, cells: impl IntoIterator<Item = C>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// Characters that each column takes, its heading included.
    pub fn widths(&self) -> Vec<usize> {
        let room = self.room();
        let width = |i: usize| {
            let heads = self.columns[i].head.iter().map(|head| head.chars().count());
            let cells = self.whole_rows().map(|row| row[i].text.chars().count() + room[i].max(mark(&row[i]).len()));
            heads.chain(cells).max().unwrap_or(0)
        };
        (0..self.columns.len()).map(width).collect()
    }

    /// Rows that have a cell for each column.
    fn whole_rows(&self) -> impl Iterator<Item = &Vec<Cell>> {
        self.rows.iter().filter(|row| row.len() == self.columns.len())
    }

    /// Where a cell of a column of numbers has a mark, the others leave room for it: digits stay below digits.
    fn room(&self) -> Vec<usize> {
        let marks = |i: usize| self.whole_rows().map(move |row| mark(&row[i]).len()).max().unwrap_or(0);
        self.columns.iter().enumerate().map(|(i, column)| if column.right { marks(i) } else { 0 }).collect()
    }

    /// For a terminal: heading, rows and footnotes.
    pub fn text(&self, layout: &TextLayout) -> String {
        let (room, mut widths) = (self.room(), self.widths());
        for (width, least) in widths.iter_mut().zip(&layout.least) {
            *width = (*width).max(*least);
        }
        let (indent, gap) = (" ".repeat(layout.indent), " ".repeat(layout.gap));
        let line = |cells: &[String]| {
            let padded: Vec<String> = cells
                .iter()
                .zip(self.columns.iter().zip(&widths))
                .map(|(text, (column, &w))| if column.right { format!("{text:>w$}") } else { format!("{text:<w$}") })
                .collect();
            format!("{}\n", format!("{indent}{}", padded.join(&gap)).trim_end())
        };
        let mut out = String::new();
        let head_lines = self.columns.iter().map(|column| column.head.len()).max().unwrap_or(0);
        for i in 0..head_lines {
            let heads: Vec<String> = self.columns.iter().map(|c| c.head.get(i).cloned().unwrap_or_default()).collect();
            out += &line(&heads);
        }
        if layout.rule {
            let between = layout.gap * widths.len().saturating_sub(1);
            out += &format!("{indent}{}\n", "-".repeat(widths.iter().sum::<usize>() + between));
        }
        for row in &self.rows {
            let cells: Vec<String> = match row.len() == self.columns.len() {
                true => row.iter().zip(&room).map(|(c, room)| format!("{}{:<room$}", c.text, mark(c))).collect(),
                false => row.iter().map(|cell| cell.text.clone()).collect(),
            };
            out += &line(&cells);
        }
        for (i, note) in self.notes.iter().enumerate() {
            // Writing to a String cannot fail.
            let _ = writeln!(out, "{indent}({}) {note}", note_mark(i));
        }
        out
    }

    /// For a spreadsheet: the first line of each heading, then the rows.
    ///
    /// # Errors
    /// When a row cannot be written, which only a fault of this program explains.
    pub fn csv(&self) -> Result<String> {
        let failed =
            |e: csv::Error| Error::output("CSV", format!("cannot be written ({e})"), "use the JSON file instead");
        let mut writer = csv::Writer::from_writer(Vec::new());
        let heads = self.columns.iter().map(|column| column.head.first().map_or("", String::as_str));
        writer.write_record(heads).map_err(failed)?;
        for row in &self.rows {
            writer.write_record(row.iter().map(|cell| cell.text.as_str())).map_err(failed)?;
        }
        let bytes = writer.into_inner().map_err(|e| failed(e.into_error().into()))?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

/// `a` for the first footnote, `b` for the second, ...
pub fn note_mark(note: usize) -> String {
    match u8::try_from(note) {
        Ok(n) if n < 26 => char::from(b'a' + n).to_string(),
        _ => format!("n{}", note + 1),
    }
}

/// ` (a)`, or nothing.
fn mark(cell: &Cell) -> String {
    cell.note.map(|note| format!(" ({})", note_mark(note))).unwrap_or_default()
}
