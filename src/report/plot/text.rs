//! Text in pictures: the font that comes with the program, how wide a text is, and how it is written into SVG.
//!
//! Roboto 2.138 (Apache-2.0, `assets/Roboto-LICENSE.txt`) in Regular and Medium. Widths are those of the layout that makes the PNG, kerning
//! and combining marks included. `_{…}` in a text is a subscript. The SVG holds text as text; a viewer without Roboto takes a sans-serif of about the same widths.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use resvg::usvg;

use super::chart::Anchor;
use super::error::PlotError;
use super::style::hex;

const FONTS: [&[u8]; 2] = [include_bytes!("../../../assets/Roboto-Regular.ttf"), include_bytes!("../../../assets/Roboto-Medium.ttf")];

/// The font and what stands in for it.
pub(super) const FAMILY: &str = "Roboto, 'Helvetica Neue', Helvetica, Arial, 'Liberation Sans', sans-serif";

/// Height of capitals above the line, in sizes of the text.
pub(super) const CAP_EM: f64 = 0.72;
/// Depth of descenders, in sizes of the text.
pub(super) const DESCENT_EM: f64 = 0.22;

/// Size of a subscript and how far below the line it stands, in sizes of the text.
const SUBSCRIPT_SIZE: f64 = 0.72;
const SUBSCRIPT_DROP_EM: f64 = 0.18;

/// Regular or bold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Weight {
    Regular,
    Medium,
}

impl Weight {
    fn number(self) -> u16 {
        match self {
            Self::Regular => 400,
            Self::Medium => 500,
        }
    }
}

/// Settings of the SVG reader: our font and no other.
pub(super) fn options() -> usvg::Options<'static> {
    static FONT_DATABASE: OnceLock<Arc<usvg::fontdb::Database>> = OnceLock::new();
    let database = FONT_DATABASE.get_or_init(|| {
        let mut database = usvg::fontdb::Database::new();
        for font in FONTS {
            database.load_font_source(usvg::fontdb::Source::Binary(Arc::new(font)));
        }
        Arc::new(database)
    });
    usvg::Options { fontdb: Arc::clone(database), font_family: "Roboto".to_owned(), ..usvg::Options::default() }
}

/// Widths of the texts of one picture.
#[derive(Debug, Default)]
pub(super) struct Ruler {
    widths_em: BTreeMap<(Weight, String), f64>,
}

impl Ruler {
    /// Lays every text out once.
    pub(super) fn new<'a>(texts: impl IntoIterator<Item = (&'a str, Weight)>) -> Result<Self, PlotError> {
        const SIZE: f64 = 100.0;
        let mut keys: Vec<(Weight, String)> = texts.into_iter().map(|(text, weight)| (weight, text.to_owned())).collect();
        keys.sort();
        keys.dedup();
        let mut document = format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"10\" height=\"10\" font-family=\"{FAMILY}\">");
        for (index, (weight, text)) in keys.iter().enumerate() {
            let weight = weight.number();
            document += &format!("<text id=\"t{index}\" font-size=\"{SIZE}\" font-weight=\"{weight}\">{}</text>", content(text, SIZE));
        }
        document += "</svg>";
        let tree = usvg::Tree::from_str(&document, &options()).map_err(|e| PlotError::Drawing(e.to_string()))?;
        let mut widths_em: BTreeMap<_, _> = keys.iter().map(|key| (key.clone(), 0.0)).collect();
        for node in tree.root().children() {
            let usvg::Node::Text(text) = node else { continue };
            let key = text.id().get(1..).and_then(|index| index.parse::<usize>().ok()).and_then(|index| keys.get(index));
            if let Some(width) = key.and_then(|key| widths_em.get_mut(key)) {
                *width = f64::from(text.bounding_box().width()) / SIZE;
            }
        }
        Ok(Self { widths_em })
    }

    /// Width of a text at a size, px. Text that was not announced is taken as wide.
    pub(super) fn width(&self, text: &str, weight: Weight, size_px: f64) -> f64 {
        let em = self.widths_em.get(&(weight, text.to_owned())).copied();
        size_px * em.unwrap_or(0.7 * text.chars().count() as f64)
    }

    /// Cuts a text into lines no wider than `room_px` at the spaces between words; every word has to be announced.
    pub(super) fn lines(&self, text: &str, weight: Weight, size_px: f64, room_px: f64) -> Vec<String> {
        let space = 0.25 * size_px;
        let mut lines: Vec<(String, f64)> = Vec::new();
        for word in text.split_whitespace() {
            let width = self.width(word, weight, size_px);
            match lines.last_mut() {
                Some((line, filled)) if *filled + space + width <= room_px => {
                    *line += " ";
                    *line += word;
                    *filled += space + width;
                }
                _ => lines.push((word.to_owned(), width)),
            }
        }
        lines.into_iter().map(|(line, _)| line).collect()
    }
}

/// A line of text in its place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Written {
    pub(super) text: String,
    pub(super) x: f64,
    /// The line on which the letters stand.
    pub(super) baseline: f64,
    pub(super) size_px: f64,
    pub(super) weight: Weight,
    pub(super) anchor: Anchor,
    pub(super) colour: [u8; 3],
}

impl Written {
    /// The element.
    pub(super) fn svg(&self) -> String {
        let anchor = match self.anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let weight = match self.weight {
            Weight::Regular => "",
            Weight::Medium => " font-weight=\"500\"",
        };
        let (x, y, size) = (number(self.x), number(self.baseline), number(self.size_px));
        format!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\"{weight}{anchor} fill=\"{}\">{}</text>\n",
            hex(self.colour),
            content(&self.text, self.size_px)
        )
    }
}

/// The pieces of a text and whether each is a subscript.
fn runs(text: &str) -> Vec<(&str, bool)> {
    let mut runs = Vec::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("_{") {
        let Some((below, after)) = after.split_once('}') else { break };
        runs.extend([(before, false), (below, true)]);
        rest = after;
    }
    runs.push((rest, false));
    runs.retain(|(run, _)| !run.is_empty());
    runs
}

/// A text without its marks, for tables and descriptions: `V_F(λ)`.
pub(super) fn plain(text: &str) -> String {
    runs(text).into_iter().map(|(run, below)| if below { format!("_{run}") } else { run.to_owned() }).collect()
}

/// What stands inside a text element of a size.
fn content(text: &str, size_px: f64) -> String {
    let drop = SUBSCRIPT_DROP_EM * size_px;
    let mut out = String::new();
    let mut lowered = false;
    for (run, below) in runs(text) {
        let run = escaped(run);
        match (below, lowered) {
            (true, _) => {
                let small = number(SUBSCRIPT_SIZE * size_px);
                out += &format!("<tspan dy=\"{}\" font-size=\"{small}\">{run}</tspan>", number(drop));
            }
            // A shift holds for all that follows, so it is taken back.
            (false, true) => out += &format!("<tspan dy=\"{}\">{run}</tspan>", number(-drop)),
            (false, false) => out += &run,
        }
        lowered = below;
    }
    out
}

/// Two decimals, without trailing zeros.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Text as XML takes it; characters that XML does not know become U+FFFD.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => out.push(' '),
            '\u{0}'..='\u{1f}' | '\u{7f}'..='\u{9f}' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_those_of_the_font() {
        let ruler =
            Ruler::new([("0", Weight::Regular), ("00000", Weight::Regular), ("x̄", Weight::Regular), ("x", Weight::Regular)]).unwrap();
        let width = |text| ruler.width(text, Weight::Regular, 1.0);
        assert!((width("0") - 1150.0 / 2048.0).abs() < 1e-3, "{}", width("0"));
        assert!((width("00000") - 5.0 * width("0")).abs() < 1e-3);
        assert!((width("x̄") - width("x")).abs() < 1e-3, "a combining mark takes no room");
    }

    #[test]
    fn nothing_that_is_written_can_break_the_document() {
        assert_eq!(escaped("a<b> & \"c\"\u{1}\n"), "a&lt;b&gt; &amp; &quot;c&quot;\u{fffd} ");
    }

    #[test]
    fn subscripts_are_lowered_and_taken_back() {
        let svg = content("V_{F}(λ) < 1", 10.0);
        assert_eq!(svg, "V<tspan dy=\"1.8\" font-size=\"7.2\">F</tspan><tspan dy=\"-1.8\">(λ) &lt; 1</tspan>");
        assert_eq!([plain("V_{F}(λ)"), plain("a_b {c} _{"), content("a_{b", 1.0)], ["V_F(λ)", "a_b {c} _{", "a_{b"].map(str::to_owned));
    }

    #[test]
    fn long_titles_are_cut_between_words() {
        let words = ["one", "two", "three"];
        let ruler = Ruler::new(words.map(|word| (word, Weight::Regular))).unwrap();
        assert_eq!(ruler.lines("one two three", Weight::Regular, 10.0, 40.0), ["one two", "three"]);
    }
}
