//! A self-contained page: text, tables and figures, nothing loaded from anywhere.

use askama::Template;

use super::figure::Figure;

/// One piece of a page. All text is plain; the page escapes it.
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// A heading, which begins a part.
    Heading(String),
    /// A heading within a part.
    Subheading(String),
    /// The first sentences.
    Lead(String),
    /// A paragraph.
    Text(String),
    /// A paragraph in small print.
    Note(String),
    /// What the numbers come to, set apart; one sentence a line.
    Verdict(Vec<String>),
    /// Something to type.
    Code(String),
    /// Figures side by side as far as there is room.
    Figures(Vec<Figure>),
    /// A table.
    Table(Table),
    /// A table whose first column says how each row stands, in colour; its texts may take several lines.
    Marked(Table, Vec<Mark>),
}

/// How a row of a table stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// As it should.
    Good,
    /// Otherwise, and it is known why.
    Watch,
    /// Not known.
    Open,
}

impl Mark {
    /// The name of its style on the page.
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
    /// How many of the first columns hold words: they are set to the left, numbers to the right.
    pub text_columns: usize,
}

/// A page to be.
#[derive(Debug, Clone, PartialEq, Template)]
#[template(path = "page.html")]
pub struct Page {
    title: String,
    blocks: Vec<Block>,
    foot: String,
    version: &'static str,
}

impl Page {
    /// An empty page.
    pub fn new(title: &str) -> Self {
        let version = env!("CARGO_PKG_VERSION");
        Self { title: title.to_owned(), blocks: Vec::new(), foot: String::new(), version }
    }

    /// Adds a piece.
    pub fn add(&mut self, block: Block) {
        self.blocks.push(block);
    }

    /// What stands at the very end, for instance how to make the page again.
    pub fn foot(&mut self, text: &str) {
        text.clone_into(&mut self.foot);
    }

    /// The page as HTML.
    ///
    /// # Errors
    /// When the template cannot be filled (it is checked when the program is compiled).
    pub fn html(&self) -> Result<String, askama::Error> {
        self.render()
    }
}

/// A number for a reader: four digits, powers of ten where they are needed.
pub fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "–".to_owned();
    }
    let magnitude = value.abs().log10().floor();
    if !(-3.0..6.0).contains(&magnitude) {
        let text = format!("{value:.3e}");
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{power}", digits.trim_end_matches('0').trim_end_matches('.'));
    }
    if value.fract() == 0.0 {
        return format!("{value:.0}");
    }
    let text = format!("{value:.*}", (3.0 - magnitude).max(0.0) as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A share for a reader, in per cent.
pub fn percent(share: f64) -> String {
    let value = 100.0 * share;
    match value.abs() {
        size if !size.is_finite() => "–".to_owned(),
        0.0 => "0 %".to_owned(),
        size if size >= 0.1 => format!("{value:.1} %"),
        size if size >= 1e-4 => format!("{value:.*} %", (1.0 - size.log10().floor()) as usize),
        _ => format!("{value:.1e} %"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let short = [0.0, 1.0, 0.123_456, 12.345_67, 123_456.0, 0.000_012_34, 2.5e9, f64::NAN].map(number);
        assert_eq!(short, ["0", "1", "0.1235", "12.35", "123456", "1.234e-5", "2.5e9", "–"]);
    }

    #[test]
    fn shares_keep_two_digits() {
        let short = [0.0, 0.1234, 0.000_057, 1.0, 1e-9, f64::NAN].map(percent);
        assert_eq!(short, ["0 %", "12.3 %", "0.0057 %", "100.0 %", "1.0e-7 %", "–"]);
    }

    #[test]
    fn text_is_escaped_and_nothing_is_loaded() {
        let mut page = Page::new("a < b");
        page.add(Block::Text("<script>".into()));
        page.add(Block::Table(Table {
            caption: String::new(),
            header: vec!["x [m]".into()],
            rows: vec![vec!["1 & 2".into()]],
            text_columns: 1,
        }));
        let html = page.html().unwrap();
        assert!(
            html.contains("a &#60; b") && html.contains("&#60;script&#62;") && html.contains("1 &#38; 2"),
            "{html}"
        );
        assert!(!html.contains("http:") && !html.contains("https:") && !html.contains("src="));
    }
}
