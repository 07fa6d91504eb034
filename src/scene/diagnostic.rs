//! What is wrong with a file: where, what was found, what is allowed, what to type instead.
//!
//! ```text
//! error: unknown key `halfangle` in `Cone`
//!   --> sensors/x.ron:12:26  acceptance
//!    |
//! 12 |     acceptance: Cone(halfangle: 0.5),
//!    |                      ^^^^^^^^^
//!    = help: did you mean `half_angle_deg`? allowed: half_angle_deg
//! ```
//!
//! Lines and columns count from 1; columns count characters.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::Range;

use super::document::Document;

/// One problem of one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The file, as it was asked for.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Column after the last character concerned on the same line; equal to `column` when only a place is meant.
    pub end_column: usize,
    /// Which value of the file, such as `sources[0].strength`; empty for the file as a whole.
    pub path: String,
    /// What is wrong, one sentence without a full stop.
    pub message: String,
    /// What is allowed and what to type instead.
    pub help: Option<String>,
    /// The text of the line, shortened about the column if it is long, and the number of characters cut off its start.
    pub excerpt: Option<(String, usize)>,
}

/// Characters of a line that are shown at most.
const WIDTH: usize = 140;

impl Diagnostic {
    /// A problem of a whole file: one that cannot be read, or is of the wrong kind.
    #[must_use]
    pub fn of_file(file: &str, message: impl Into<String>, help: Option<String>) -> Self {
        Self { file: file.into(), line: 1, column: 1, end_column: 1, path: String::new(), message: message.into(), help, excerpt: None }
    }

    /// A problem of a line of a file that is not a document, such as a curve; the excerpt is the text of the line.
    #[must_use]
    pub fn of_line(file: &str, line: usize, text: &str, message: impl Into<String>, help: Option<String>) -> Self {
        let mut problem = Self::of_file(file, message, help);
        problem.line = line.max(1);
        let width = text.trim_end().chars().count();
        problem.end_column = 1 + width;
        problem.excerpt = (width > 0).then(|| shortened(text.trim_end(), 0));
        problem
    }

    /// A problem at a column of a line of a file that is not a document; what is marked ends at the next comma, semicolon or blank.
    #[must_use]
    pub fn of_column(file: &str, line: usize, column: usize, text: &str, message: impl Into<String>, help: impl Into<String>) -> Self {
        let mut problem = Self::of_line(file, line, text, message, Some(help.into()).filter(|h| !h.is_empty()));
        problem.column = column.max(1);
        let marked = text.chars().skip(problem.column - 1).take_while(|c| !",; \t\r".contains(*c)).count();
        problem.end_column = problem.column + marked.max(1);
        problem.excerpt = (!text.trim().is_empty()).then(|| shortened(text.trim_end(), problem.column - 1));
        problem
    }

    /// A problem of a part of a document: the bytes `span`.
    #[must_use]
    pub fn at(document: &Document, span: &Range<usize>, path: &str, message: impl Into<String>, help: Option<String>) -> Self {
        let place = document.place(span);
        Self {
            file: document.file.clone(),
            line: place.line,
            column: place.column,
            end_column: place.end_column,
            path: bounded(path.into()),
            message: bounded(message.into()),
            help: help.map(bounded),
            excerpt: Some(shortened(place.text, place.column - 1)),
        }
    }
}

/// A text that is not too long to be read, whatever the names in it.
fn bounded(text: String) -> String {
    const MOST_CHARACTERS: usize = 600;
    match text.char_indices().nth(MOST_CHARACTERS) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

/// Some lines of a file by number, without their ends.
pub(super) fn lines_of(bytes: &[u8], numbers: impl Iterator<Item = usize>) -> BTreeMap<usize, &[u8]> {
    let wanted: BTreeSet<usize> = numbers.collect();
    let last = wanted.last().copied().unwrap_or(0);
    let lines = bytes.split(|&b| b == b'\n').take(last).enumerate().map(|(i, line)| (i + 1, line.strip_suffix(b"\r").unwrap_or(line)));
    lines.filter(|(number, _)| wanted.contains(number)).collect()
}

/// The part of a line about a character, and how many characters were cut off before it; control characters become blanks.
fn shortened(text: &str, about: usize) -> (String, usize) {
    let cut = if text.chars().nth(WIDTH).is_some() { about.saturating_sub(WIDTH / 2) } else { 0 };
    let part = text.chars().skip(cut).take(WIDTH).map(|c| if c.is_control() { ' ' } else { c }).collect();
    (part, cut)
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = self.line.to_string();
        let gap = " ".repeat(number.len());
        write!(f, "error: {}\n{gap}--> {}", self.message, self.file)?;
        if self.excerpt.is_some() {
            write!(f, ":{}:{}", self.line, self.column)?;
        }
        if !self.path.is_empty() {
            write!(f, "  {}", self.path)?;
        }
        if let Some((text, cut)) = &self.excerpt {
            let dots = if *cut > 0 { "…" } else { "" };
            let width = text.chars().count();
            let before = (self.column - 1).saturating_sub(*cut).min(width) + dots.chars().count();
            let marked = self.end_column.saturating_sub(self.column).clamp(1, (width + 2).saturating_sub(before).max(1));
            write!(f, "\n{gap} |\n{number} | {dots}{text}\n{gap} | {}{}", " ".repeat(before), "^".repeat(marked))?;
        }
        if let Some(help) = &self.help {
            write!(f, "\n{gap} = help: {help}")?;
        }
        Ok(())
    }
}

/// Every problem that was found, at least one.
#[derive(Clone, Debug, Default, PartialEq, Eq, thiserror::Error)]
pub struct Diagnostics(pub Vec<Diagnostic>);

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.0.iter().enumerate() {
            write!(f, "{}{problem}", if i == 0 { "" } else { "\n\n" })?;
        }
        Ok(())
    }
}

/// Problems that are told at most; the others are counted. What a hostile file can make this program do is bounded by it.
const MOST: usize = 200;

/// A list of problems that grows while files are read.
#[derive(Debug, Default)]
pub(super) struct Problems {
    list: Vec<Diagnostic>,
    more: usize,
    first_file: String,
}

impl Problems {
    /// No problems yet; those of `first_file` will be told first.
    pub(super) fn new(first_file: &str) -> Self {
        Self { list: Vec::new(), more: 0, first_file: first_file.into() }
    }

    /// Adds a problem.
    pub(super) fn add(&mut self, problem: Diagnostic) {
        if self.is_full() {
            self.skip();
        } else {
            self.list.push(problem);
        }
    }

    /// Counts a problem without its words.
    pub(super) fn skip(&mut self) {
        self.more += 1;
    }

    /// Whether further problems are only counted, so that their words need not be found.
    pub(super) fn is_full(&self) -> bool {
        self.list.len() >= MOST
    }

    /// How many there are so far.
    pub(super) fn count(&self) -> usize {
        self.list.len() + self.more
    }

    /// All of them: file by file, the first file first and the others in the order in which they were met, from the first line
    /// to the last.
    pub(super) fn finish(mut self) -> Diagnostics {
        let mut files: Vec<String> = vec![self.first_file.clone()];
        for problem in &self.list {
            if !files.contains(&problem.file) {
                files.push(problem.file.clone());
            }
        }
        let rank = |file: &str| files.iter().position(|f| f == file);
        self.list.sort_by_key(|p| (rank(&p.file), p.line, p.column));
        self.list.dedup();
        if self.more > 0 {
            let message = format!("{} more problems are not told", self.more);
            self.list.push(Diagnostic::of_file(&self.first_file, message, Some("mend the first ones and read the scene again".into())));
        }
        Diagnostics(self.list)
    }
}
