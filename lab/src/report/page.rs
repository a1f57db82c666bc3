//! A self-contained HTML page of text, tables and figures that loads nothing from elsewhere.

use askama::Template;

use super::chart::Figure;

/// Fewest headings with a list of contents.
const LISTED_HEADINGS: usize = 3;

/// One section of a page. All text is plain; the template escapes it.
#[derive(Debug, Clone, PartialEq)]
enum PagePart {
    /// Links to all headings.
    Heading(String),
    Subheading(String),
    Lead(String),
    Text(String),
    Note(String),
    Verdict(Vec<String>),
    Boxed(Callout),
    Code(String),
    /// Figures and the CSS class of their grid.
    Figures(Vec<Figure>, &'static str),
    /// Figures for each value of something, with a heading; a browser shows one value at a time beside a slider.
    Steps(Vec<(String, Vec<Figure>)>),
    Table(Table),
    Marked(Table, Vec<RowStatus>),
}

/// A box with a heading, paragraphs and a table; its colour shows the status.
#[derive(Debug, Clone, PartialEq)]
pub struct Callout {
    /// Colour of the box.
    pub status: RowStatus,
    /// Heading.
    pub title: String,
    /// Paragraphs; the first one is the answer and stands out.
    pub lines: Vec<String>,
    /// A table under them.
    pub table: Option<Table>,
}

/// Status of a table row or a box, shown by a colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowStatus {
    /// As expected.
    Good,
    /// Not as expected, for a known reason.
    Watch,
    /// Unknown.
    Open,
}

impl RowStatus {
    /// CSS class.
    fn style(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Watch => "watch",
            Self::Open => "open",
        }
    }
}

/// A table of texts.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Table {
    /// A line above it.
    pub caption: String,
    /// Column heads, with units.
    pub header: Vec<String>,
    /// Rows as long as the header.
    pub rows: Vec<Vec<String>>,
    /// Number of leading text columns: they are aligned left, the others right.
    pub text_columns: usize,
}

impl Table {
    /// A table whose first `text_columns` columns hold text.
    pub fn new(caption: &str, text_columns: usize, header: &[&str], rows: Vec<Vec<String>>) -> Self {
        let header = header.iter().map(|&head| head.to_owned()).collect();
        Self { caption: caption.to_owned(), header, rows, text_columns }
    }

    /// The table for a terminal: columns of equal width under the caption.
    pub fn text(&self) -> String {
        let mut text = format!("\n{}\n", self.caption);
        let lines = std::iter::once(&self.header).chain(&self.rows);
        let width = |column: usize| {
            let cells = lines.clone().filter_map(|line| line.get(column));
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..self.header.len()).map(width).collect();
        for line in lines.clone() {
            let padded = line.iter().zip(&widths).map(|(cell, &width)| format!("{cell:<width$}"));
            text += &format!("  {}\n", padded.collect::<Vec<_>>().join("  ").trim_end());
        }
        text
    }

    /// A table with a row for each item; a column is its head and the text that it shows of an item.
    pub fn of_items<T>(
        caption: &str,
        text_columns: usize,
        items: &[T],
        columns: &[TableColumn<'_, T>],
    ) -> Self {
        let row = |item: &T| columns.iter().map(|(_, text)| text(item)).collect();
        let header: Vec<&str> = columns.iter().map(|(head, _)| *head).collect();
        Self::new(caption, text_columns, &header, items.iter().map(row).collect())
    }
}

/// Head of a column, and its text for an item.
pub type TableColumn<'a, T> = (&'a str, &'a dyn Fn(&T) -> String);

/// A page under construction; sections appear in the order in which they are added.
#[derive(Debug, Clone, PartialEq, Template)]
#[template(path = "page.html")]
pub struct Page {
    title: String,
    sections: Vec<PagePart>,
    foot: String,
    version: &'static str,
}

impl Page {
    /// An empty page.
    pub fn new(title: &str) -> Self {
        let version = env!("CARGO_PKG_VERSION");
        Self { title: title.to_owned(), sections: Vec::new(), foot: String::new(), version }
    }

    /// What the page can do in a browser.
    const SCRIPT: &str = include_str!("page.js");

    /// The headings with the places of their sections.
    fn headings(&self) -> impl Iterator<Item = (usize, &str)> {
        self.sections.iter().enumerate().filter_map(|(place, part)| match part {
            PagePart::Heading(text) => Some((place, text.as_str())),
            _ => None,
        })
    }

    /// Whether the list of contents stands before this section: the first heading of several.
    fn begins_contents(&self, place: &usize) -> bool {
        self.headings().count() >= LISTED_HEADINGS
            && self.headings().next().is_some_and(|(first, _)| first == *place)
    }

    /// Adds a heading.
    pub fn heading(&mut self, text: impl Into<String>) {
        self.sections.push(PagePart::Heading(text.into()));
    }

    /// Adds a heading of the second level.
    pub fn subheading(&mut self, text: impl Into<String>) {
        self.sections.push(PagePart::Subheading(text.into()));
    }

    /// Adds a paragraph in larger print that opens a page or a part.
    pub fn lead(&mut self, text: impl Into<String>) {
        self.sections.push(PagePart::Lead(text.into()));
    }

    /// Adds a paragraph.
    pub fn text(&mut self, text: impl Into<String>) {
        self.sections.push(PagePart::Text(text.into()));
    }

    /// Adds a paragraph in small print.
    pub fn note(&mut self, text: impl Into<String>) {
        self.sections.push(PagePart::Note(text.into()));
    }

    /// Adds the main result in a box, one paragraph per sentence.
    pub fn verdict(&mut self, sentences: Vec<String>) {
        self.sections.push(PagePart::Verdict(sentences));
    }

    /// Adds a box.
    pub fn callout(&mut self, callout: Callout) {
        self.sections.push(PagePart::Boxed(callout));
    }

    /// Adds commands or the text of a file.
    pub fn code(&mut self, text: impl Into<String>) {
        self.sections.push(PagePart::Code(text.into()));
    }

    /// Adds figures, two or more side by side where the window is wide enough; without figures adds nothing.
    pub fn figures(&mut self, figures: impl IntoIterator<Item = Figure>) {
        self.grid(figures, "figures");
    }

    /// Adds small figures, three or more side by side.
    pub fn panels(&mut self, figures: impl IntoIterator<Item = Figure>) {
        self.grid(figures, "figures panels");
    }

    fn grid(&mut self, figures: impl IntoIterator<Item = Figure>, style: &'static str) {
        let figures: Vec<Figure> = figures.into_iter().collect();
        if !figures.is_empty() {
            self.sections.push(PagePart::Figures(figures, style));
        }
    }

    /// Adds figures for each value of something, of which a slider chooses one.
    pub fn steps(&mut self, steps: Vec<(String, Vec<Figure>)>) {
        self.sections.push(PagePart::Steps(steps));
    }

    /// Adds a table.
    pub fn table(&mut self, table: Table) {
        self.sections.push(PagePart::Table(table));
    }

    /// Adds a table whose first column shows the status of each row in colour.
    pub fn marked(&mut self, table: Table, status: Vec<RowStatus>) {
        self.sections.push(PagePart::Marked(table, status));
    }

    /// Sets the last line, for instance how to make the page again.
    pub fn foot(&mut self, text: &str) {
        text.clone_into(&mut self.foot);
    }

    /// The page as HTML.
    ///
    /// # Errors
    /// When the template cannot be filled (it is checked at compile time).
    pub fn html(&self) -> Result<String, askama::Error> {
        self.render()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_escaped_and_nothing_is_loaded() {
        let mut page = Page::new("a < b");
        page.text("<script>");
        page.table(Table::new("", 1, &["x [m]"], vec![vec!["1 & 2".into()]]));
        let html = page.html().unwrap();
        assert!(
            html.contains("a &#60; b") && html.contains("&#60;script&#62;") && html.contains("1 &#38; 2"),
            "{html}"
        );
        assert!(!html.contains("http:") && !html.contains("https:") && !html.contains("src="));
    }
}
