//! The grammar of documents: from characters to values.
//!
//! ```text
//! value  = number | "text" | r#"text"# | true | false | Name | Name? ( body ) | [ list ] | { map }
//! body   = value , …  |  key: value , …
//! ```

use std::ops::Range;

use super::document::{Body, DEEPEST_NESTING, Document, Field, Kind, Node};

/// A break of syntax, with the brackets that were open there.
pub(super) struct Broken {
    pub(super) span: Range<usize>,
    pub(super) message: String,
    allowed: Option<String>,
    opened: Option<(char, usize)>,
}

impl Broken {
    /// What is allowed, and which bracket is open.
    pub(super) fn help(&self, document: &Document) -> Option<String> {
        let opened = self.opened.map(|(bracket, at)| {
            let place = document.place(&(at..at));
            format!("the `{bracket}` opened at {}:{} is not closed yet", place.line, place.column)
        });
        match (&self.allowed, opened) {
            (Some(a), Some(b)) => Some(format!("{a}; {b}")),
            (a, b) => a.clone().or(b),
        }
    }
}

/// Reads a text that holds one value.
pub(super) fn parse(text: &str) -> Parsed<Node> {
    Parser { text, at: 0, open: Vec::new() }.document()
}

struct Parser<'t> {
    text: &'t str,
    at: usize,
    /// Brackets that are open, with their places.
    open: Vec<(char, usize)>,
}

pub(super) type Parsed<T> = Result<T, Broken>;

fn starts_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

fn continues_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

impl<'t> Parser<'t> {
    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    fn next(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn broken(&self, message: impl Into<String>, allowed: Option<&str>) -> Broken {
        let span = self.at..self.at + self.next().map_or(0, char::len_utf8);
        Broken { span, message: message.into(), allowed: allowed.map(Into::into), opened: None }
    }

    fn unexpected(&self, expected: &str) -> Broken {
        let mut broken = match self.next() {
            None => self.broken(format!("the file ends where {expected} is expected"), None),
            Some(c) => self.broken(format!("`{c}` where {expected} is expected"), None),
        };
        broken.opened = self.open.last().copied();
        broken
    }

    fn eat(&mut self, token: &str) -> bool {
        let found = self.rest().starts_with(token);
        if found {
            self.at += token.len();
        }
        found
    }

    /// Skips blanks and comments; block comments nest.
    fn skip(&mut self) -> Parsed<()> {
        loop {
            let rest = self.rest();
            let blanks = rest.len() - rest.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}').len();
            self.at += blanks;
            if self.rest().starts_with("//") {
                self.at += self.rest().find('\n').unwrap_or(self.rest().len());
            } else if self.rest().starts_with("/*") {
                let start = self.at;
                let mut depth = 0usize;
                loop {
                    if self.eat("/*") {
                        depth += 1;
                    } else if self.eat("*/") {
                        depth -= 1;
                        if depth == 0 {
                            break;
                        }
                    } else if let Some(c) = self.next() {
                        self.at += c.len_utf8();
                    } else {
                        self.at = start;
                        return Err(self.broken("this comment is never closed", Some("close it with `*/`")));
                    }
                }
            } else {
                return Ok(());
            }
        }
    }

    fn document(&mut self) -> Parsed<Node> {
        self.skip()?;
        if self.eat("#!") {
            return Err(self.broken("an attribute `#![…]` at the start", Some("leave it out: no extension of the notation is needed")));
        }
        if self.next().is_none() {
            return Err(self.broken("the file is empty", Some("a scene file holds `Scene(…)`, a sensor file `Sensor(…)`")));
        }
        let root = self.value()?;
        self.skip()?;
        match self.next() {
            None => Ok(root),
            Some(c) => Err(self.broken(
                format!("`{c}` after the end of the value"),
                Some("a file holds one value; look for a bracket that closes too early"),
            )),
        }
    }

    fn name(&mut self) -> Option<&'t str> {
        let rest = self.rest();
        if !rest.starts_with(starts_name) {
            return None;
        }
        let end = rest.find(|c| !continues_name(c)).unwrap_or(rest.len());
        self.at += end;
        Some(&rest[..end])
    }

    fn value(&mut self) -> Parsed<Node> {
        let start = self.at;
        let kind = match self.next() {
            Some('(') => self.body(String::new())?,
            Some('[') => Kind::List(self.sequence(']', Self::value)?),
            Some('{') => Kind::Map(self.sequence('}', Self::entry)?),
            Some('"') => Kind::Text(self.text()?),
            Some('r') if self.rest().starts_with("r\"") || self.rest().starts_with("r#") => Kind::Text(self.raw_text()?),
            Some('0'..='9' | '+' | '-' | '.') => Kind::Number(self.number()?),
            Some('\'') => return Err(self.broken("a single quote", Some("names and other texts are written in double quotes: \"…\""))),
            _ => match self.name() {
                Some("true") => Kind::Bool(true),
                Some("false") => Kind::Bool(false),
                Some("NaN") => Kind::Number(f64::NAN),
                Some("inf") => Kind::Number(f64::INFINITY),
                Some(name) => {
                    let end = self.at;
                    self.skip()?;
                    if self.next() == Some('(') {
                        self.body(name.into())?
                    } else {
                        self.at = end;
                        Kind::Struct { name: name.into(), body: Body::None }
                    }
                }
                None => return Err(self.unexpected("a value")),
            },
        };
        Ok(Node { span: start..self.at, kind })
    }

    /// A bracket, items with commas between them, and the bracket that closes.
    fn sequence<T>(&mut self, close: char, item: impl Fn(&mut Self) -> Parsed<T>) -> Parsed<Vec<T>> {
        if let Some(bracket) = self.next() {
            if self.open.len() >= DEEPEST_NESTING {
                return Err(self.broken("brackets are nested too deeply", Some(&format!("at most {DEEPEST_NESTING} levels are read"))));
            }
            self.open.push((bracket, self.at));
            self.at += bracket.len_utf8();
        }
        let mut items = Vec::new();
        loop {
            self.skip()?;
            if self.next() == Some(close) {
                break;
            }
            items.push(item(self)?);
            self.skip()?;
            if !self.eat(",") && self.next() != Some(close) {
                return Err(self.unexpected(&format!("`,` or `{close}`")));
            }
        }
        self.at += close.len_utf8();
        self.open.pop();
        Ok(items)
    }

    fn entry(&mut self) -> Parsed<(Node, Node)> {
        let key = self.value()?;
        self.skip()?;
        if !self.eat(":") {
            return Err(self.unexpected("`:` between a key and its value"));
        }
        self.skip()?;
        Ok((key, self.value()?))
    }

    /// What round brackets hold. Either every value has a key or none has.
    fn body(&mut self, name: String) -> Parsed<Kind> {
        let items = self.sequence(')', |parser| {
            let start = parser.at;
            let _raw_name = parser.rest().starts_with("r#") && !parser.rest().starts_with("r#\"") && parser.eat("r#");
            if let Some(key) = parser.name() {
                let name_span = start..parser.at;
                parser.skip()?;
                if parser.eat(":") {
                    parser.skip()?;
                    return Ok((Some((key.to_string(), name_span)), parser.value()?));
                }
            }
            parser.at = start;
            Ok((None, parser.value()?))
        })?;
        let named = items.iter().filter(|(key, _)| key.is_some()).count();
        if named == 0 {
            return Ok(Kind::Struct { name, body: Body::Positional(items.into_iter().map(|(_, value)| value).collect()) });
        }
        if let Some((_, lone)) = items.iter().find(|(key, _)| key.is_none()) {
            let mut broken = self.broken("a value without a key among values with keys", Some("write `key: value`"));
            broken.span = lone.span.clone();
            return Err(broken);
        }
        let fields = items.into_iter().filter_map(|(key, value)| key.map(|(name, name_span)| Field { name, name_span, value })).collect();
        Ok(Kind::Struct { name, body: Body::Named(fields) })
    }

    fn number(&mut self) -> Parsed<f64> {
        let start = self.at;
        let sign = if self.eat("-") {
            -1.0
        } else {
            self.eat("+");
            1.0
        };
        let rest = self.rest();
        let word = |c: char| continues_name(c) || c == '.';
        let mut end = rest.find(|c| !word(c)).unwrap_or(rest.len());
        // The sign of an exponent belongs to the number.
        if rest[..end].ends_with(['e', 'E'])
            && rest.starts_with(|c: char| c.is_ascii_digit() || c == '.')
            && rest[end..].starts_with(['+', '-'])
        {
            end += 1 + rest[end + 1..].find(|c| !word(c)).unwrap_or(rest.len() - end - 1);
        }
        let digits = rest[..end].replace('_', "");
        let value = match digits.as_str() {
            "inf" => Some(f64::INFINITY),
            "NaN" => Some(f64::NAN),
            _ if digits.starts_with(|c: char| c.is_ascii_digit() || c == '.') => digits.parse::<f64>().ok(),
            _ => None,
        };
        self.at += end;
        value.map(|v| sign * v).ok_or_else(|| {
            let mut broken = self.broken(format!("`{}` is not a number", &self.text[start..self.at]), Some("write 0.3, -2, 1e-4"));
            broken.span = start..self.at.max(start + 1);
            broken
        })
    }

    fn raw_text(&mut self) -> Parsed<String> {
        let start = self.at;
        self.eat("r");
        let hashes = self.rest().len() - self.rest().trim_start_matches('#').len();
        self.at += hashes;
        let close = format!("\"{}", "#".repeat(hashes));
        if self.eat("\"")
            && let Some(end) = self.rest().find(&close)
        {
            let text = self.rest()[..end].to_string();
            self.at += end + close.len();
            return Ok(text);
        }
        self.at = start;
        Err(self.broken("this text is never closed", Some(&format!("close it with `{close}`"))))
    }

    fn text(&mut self) -> Parsed<String> {
        let start = self.at;
        self.eat("\"");
        let mut text = String::new();
        while let Some(c) = self.next() {
            self.at += c.len_utf8();
            match c {
                '"' => return Ok(text),
                '\\' => text.push(self.escape()?),
                _ => text.push(c),
            }
        }
        self.at = start;
        Err(self.broken("this text is never closed", Some("close it with `\"`")))
    }

    fn escape(&mut self) -> Parsed<char> {
        let start = self.at - 1;
        let Some(c) = self.next() else { return Ok('\\') };
        self.at += c.len_utf8();
        let code = |digits: &str| u32::from_str_radix(digits, 16).ok().and_then(char::from_u32);
        let found = match c {
            'n' => Some('\n'),
            'r' => Some('\r'),
            't' => Some('\t'),
            '0' => Some('\0'),
            '\\' | '"' | '\'' => Some(c),
            'x' => {
                let digits: String = self.rest().chars().take(2).collect();
                self.at += digits.len();
                code(&digits)
            }
            'u' if self.eat("{") => {
                let digits: String = self.rest().chars().take_while(|&c| c != '}' && c != '"').take(8).collect();
                self.at += digits.len();
                if self.eat("}") { code(&digits) } else { None }
            }
            _ => None,
        };
        found.ok_or_else(|| {
            let mut broken = self.broken(
                "an unknown escape in a text",
                Some("write `\\\\` for one backslash; allowed: \\n \\r \\t \\0 \\\\ \\\" \\' \\xNN \\u{NNNN}"),
            );
            broken.span = start..self.at;
            broken
        })
    }
}
