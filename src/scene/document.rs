//! Text in Rusty Object Notation → a tree of values, each with its place.
//!
//! The `ron` crate hands a text to `serde` types and stops at the first mismatch; here every value is kept with its place,
//! so that all problems of a file can be told at once. `syntax.rs` has the grammar; tests hold it against that crate.

use std::ops::Range;

use super::diagnostic::Diagnostic;
use super::syntax;

/// How deep brackets may be nested.
pub const DEEPEST_NESTING: usize = 64;

/// A text, the places of its lines, and the value that it holds.
#[derive(Clone, Debug)]
pub struct Document {
    /// The file, as it was asked for.
    pub file: String,
    text: String,
    line_starts: Vec<usize>,
    /// The value.
    pub root: Node,
}

/// A value with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Bytes of the text.
    pub span: Range<usize>,
    /// What it is.
    pub kind: Kind,
}

/// What a value is.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A number, `NaN` and `inf` among them.
    Number(f64),
    /// A string.
    Text(String),
    /// `true` or `false`.
    Bool(bool),
    /// `Name`, `Name(…)` or `(…)`.
    Struct {
        /// The name in front of the bracket, empty if there is none.
        name: String,
        /// What the bracket holds.
        body: Body,
    },
    /// `[…]`
    List(Vec<Node>),
    /// `{key: value, …}`
    Map(Vec<(Node, Node)>),
}

/// What the round brackets of a struct hold.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// There are no brackets.
    None,
    /// Values one after the other.
    Positional(Vec<Node>),
    /// Values with keys.
    Named(Vec<Field>),
}

/// A value with its key.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// The key.
    pub name: String,
    /// Where the key stands.
    pub name_span: Range<usize>,
    /// The value.
    pub value: Node,
}

/// Line and columns of a piece of text.
pub(super) struct Place<'t> {
    /// From 1.
    pub(super) line: usize,
    /// In characters, from 1.
    pub(super) column: usize,
    /// After the last character on the same line.
    pub(super) end_column: usize,
    /// The text of the line.
    pub(super) text: &'t str,
}

impl Document {
    /// Reads a text. The error is the first break of syntax.
    pub fn parse(file: &str, text: &str) -> Result<Document, Box<Diagnostic>> {
        let line_starts = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        let nothing = Node { span: 0..0, kind: Kind::List(Vec::new()) };
        let mut document = Document { file: file.into(), text: text.into(), line_starts, root: nothing };
        match syntax::parse(text) {
            Ok(root) => {
                document.root = root;
                Ok(document)
            }
            Err(broken) => {
                let help = broken.help(&document);
                Err(Box::new(Diagnostic::at(&document, &broken.span, "", broken.message, help)))
            }
        }
    }

    /// A text that is one value as it stands: no quotes, no escapes, no comments.
    pub(super) fn of_text(file: &str, text: &str) -> Document {
        let line_starts = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        let root = Node { span: 0..text.len(), kind: Kind::Text(text.into()) };
        Document { file: file.into(), text: text.into(), line_starts, root }
    }

    /// Some bytes of the text; empty if they are not there.
    pub(super) fn slice(&self, span: &Range<usize>) -> &str {
        self.text.get(span.clone()).unwrap_or_default()
    }

    /// Where some bytes of the text are.
    pub(super) fn place(&self, span: &Range<usize>) -> Place<'_> {
        let start = span.start.min(self.text.len());
        let line = self.line_starts.partition_point(|&s| s <= start).max(1);
        let from = self.line_starts[line - 1];
        let to = self.line_starts.get(line).map_or(self.text.len(), |next| next - 1);
        let text = self.text[from..to].trim_end_matches('\r');
        let column = 1 + self.text[from..start].chars().count();
        let end = span.end.clamp(start, to.max(start));
        Place { line, column, end_column: column + self.text[start..end].chars().count(), text }
    }
}
