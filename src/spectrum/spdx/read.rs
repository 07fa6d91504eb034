//! From XML to a spectrum, or all problems with their places.

use roxmltree::{Document, Node, ParsingOptions};

use super::{HEADER, Spdx, SpdxHeader, SpectralQuantity};
use crate::spectrum::table_text::{TextProblem, utf8};

/// Most nodes of a document.
const MOST_NODES: u32 = 2_000_000;
/// Deepest nesting of elements.
const DEEPEST: usize = 16;
/// More problems than this are counted, not listed.
const MOST_PROBLEMS: usize = 100;

const GEOMETRIES: [&str; 7] = ["0:0", "di:0", "de:0", "0:di", "0:de", "d:d", "other"];

struct Reader<'d> {
    document: &'d Document<'d>,
    problems: Vec<TextProblem>,
    more: usize,
    remarks: Vec<String>,
}

/// Reads a document.
///
/// # Errors
/// Every problem with its line and column; a break of the XML ends the reading.
pub fn read(bytes: &[u8]) -> Result<Spdx, Vec<TextProblem>> {
    let text = utf8(bytes).map_err(|problem| vec![problem])?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    too_deep(text).map_or(Ok(()), |problem| Err(vec![problem]))?;
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let place = error.pos();
        let help = match error {
            roxmltree::Error::DtdDetected => "remove the document type definition",
            roxmltree::Error::NodesLimitReached => "at most two million nodes are read; thin the table",
            _ => "the file is to be XML as IES TM-27 has it",
        };
        let (line, column) = (place.row as usize, place.col as usize);
        vec![TextProblem { line: line.max(1), column: column.max(1), message: format!("the XML is broken: {error}"), help: help.into() }]
    })?;
    let mut reader = Reader { document: &document, problems: Vec::new(), more: 0, remarks: Vec::new() };
    let found = reader.document(document.root_element());
    if reader.more > 0 {
        let message = format!("and {} more problems", reader.more);
        reader.problems.push(TextProblem { line: 1, column: 1, message, help: "correct the ones listed first".into() });
    }
    match found {
        Some(found) if reader.problems.is_empty() => Ok(Spdx { remarks: reader.remarks, ..found }),
        _ => Err(reader.problems),
    }
}

/// A problem if tags are nested too deeply. Only an upper bound of the depth is needed, so tags in comments count as well.
fn too_deep(text: &str) -> Option<TextProblem> {
    let mut depth = 0_usize;
    for (line, content) in text.split('\n').enumerate() {
        for (at, _) in content.match_indices('<') {
            let rest = &content[at + 1..];
            if rest.starts_with('/') {
                depth = depth.saturating_sub(1);
            } else if rest.starts_with(|c: char| c.is_alphabetic() || c == '_' || c == ':') {
                // An element without content closes itself; one that does so on a later line counts until the next end tag.
                let closed = rest.find(['<', '>']).is_some_and(|end| rest[..end].ends_with('/'));
                depth += usize::from(!closed);
            }
            if depth > DEEPEST {
                let column = content[..at].chars().count() + 1;
                let message = format!("elements are nested deeper than {DEEPEST}");
                return Some(TextProblem { line: line + 1, column, message, help: "IES TM-27 needs three".into() });
            }
        }
    }
    None
}

/// The text of an element without the blanks around it.
fn text_of<'d>(node: Node<'d, 'd>) -> &'d str {
    node.text().unwrap_or_default().trim()
}

/// A text that is not too long for a message.
fn shown(text: &str) -> String {
    text.chars().take(40).collect()
}

impl<'d> Reader<'d> {
    fn place(&self, node: Node) -> (usize, usize) {
        let place = self.document.text_pos_at(node.range().start);
        (place.row as usize, place.col as usize)
    }

    fn problem(&mut self, node: Node, message: impl Into<String>, help: impl Into<String>) {
        if self.problems.len() >= MOST_PROBLEMS {
            self.more += 1;
            return;
        }
        let (line, column) = self.place(node);
        self.problems.push(TextProblem { line, column, message: message.into(), help: help.into() });
    }

    fn document(&mut self, root: Node<'d, 'd>) -> Option<Spdx> {
        if root.tag_name().name() != "IESTM2714" {
            let message = format!("the document is a `{}`", shown(root.tag_name().name()));
            self.problem(root, message, "a spectrum of IES TM-27 is an `IESTM2714`");
            return None;
        }
        let parts = |name: &'static str| root.children().filter(move |node| node.is_element() && node.tag_name().name() == name);
        let header = parts("Header").next().map(|node| self.header(node)).unwrap_or_default();
        self.unknown(root, &["Header", "SpectralDistribution"]);
        let mut distributions = parts("SpectralDistribution");
        let Some(distribution) = distributions.next() else {
            self.problem(root, "there is no `SpectralDistribution`", "add `<SpectralDistribution> … </SpectralDistribution>`");
            return None;
        };
        if let Some(second) = distributions.next() {
            self.problem(second, "there is a second `SpectralDistribution`", "keep one spectrum in a file");
        }
        self.distribution(distribution, header)
    }

    /// Says which children are none that the format knows, once for each name.
    fn unknown(&mut self, parent: Node<'d, 'd>, known: &[&str]) {
        let mut told: Vec<&str> = Vec::new();
        for node in parent.children().filter(Node::is_element) {
            let name = node.tag_name().name();
            if !known.contains(&name) && !told.contains(&name) && told.len() < 10 {
                told.push(name);
                let (line, _) = self.place(node);
                self.remarks.push(format!("line {line}: the element `{}` is not part of IES TM-27 and is left out", shown(name)));
            }
        }
    }

    fn header(&mut self, node: Node<'d, 'd>) -> SpdxHeader {
        let mut header = SpdxHeader::default();
        for ((element, ..), field) in HEADER.iter().zip(header.fields_mut()) {
            let child = node.children().find(|child| child.tag_name().name() == *element);
            *field = child.map(text_of).filter(|text| !text.is_empty()).map(str::to_owned);
        }
        self.unknown(node, &HEADER.map(|(element, ..)| element));
        header
    }

    fn distribution(&mut self, node: Node<'d, 'd>, header: SpdxHeader) -> Option<Spdx> {
        let known =
            ["SpectralQuantity", "ReflectionGeometry", "TransmissionGeometry", "BandwidthFWHM", "BandwidthCorrected", "SpectralData"];
        self.unknown(node, &known);
        let child = |name: &'static str| node.children().find(|child| child.tag_name().name() == name);
        for name in known.into_iter().filter(|name| *name != "SpectralData") {
            if let Some(second) = node.children().filter(|child| child.tag_name().name() == name).nth(1) {
                self.problem(second, format!("there is a second `{name}`"), "keep one of them");
            }
        }
        let quantity = match child("SpectralQuantity") {
            Some(element) => self.quantity(element).map(|quantity| (quantity, self.place(element))),
            None => {
                let help = format!("add `<SpectralQuantity>flux</SpectralQuantity>`; allowed: {}", names());
                self.problem(node, "there is no `SpectralQuantity`", help);
                None
            }
        };
        let mut geometry = |name: &'static str| {
            let element = child(name)?;
            let text = text_of(element);
            if !text.is_empty() && text != "None" && !GEOMETRIES.contains(&text) {
                self.problem(element, format!("the geometry is `{}`", shown(text)), format!("allowed: {}", GEOMETRIES.join(", ")));
            }
            (!text.is_empty() && text != "None").then(|| text.to_owned())
        };
        let (reflection_geometry, transmission_geometry) = (geometry("ReflectionGeometry"), geometry("TransmissionGeometry"));
        let bandwidth_fwhm_nm = child("BandwidthFWHM").filter(|element| !matches!(text_of(*element), "" | "None")).and_then(|element| {
            let width = self.number(element, text_of(element))?;
            if width < 0.0 {
                self.problem(element, format!("the bandwidth is {width} nm"), "allowed: 0 nm and above");
            }
            Some(width)
        });
        let bandwidth_corrected = child("BandwidthCorrected").and_then(|element| match text_of(element) {
            "true" | "1" => Some(true),
            "false" | "0" => Some(false),
            "" => None,
            other => {
                self.problem(element, format!("`BandwidthCorrected` is `{}`", shown(other)), "allowed: true, false");
                None
            }
        });
        let (wavelengths_nm, values) = self.rows(node);
        let (quantity, quantity_place) = quantity?;
        Some(Spdx {
            header,
            quantity,
            quantity_place,
            reflection_geometry,
            transmission_geometry,
            bandwidth_fwhm_nm,
            bandwidth_corrected,
            wavelengths_nm,
            values,
            remarks: Vec::new(),
        })
    }

    fn quantity(&mut self, element: Node) -> Option<SpectralQuantity> {
        let name = element.text().unwrap_or_default().trim();
        let found = SpectralQuantity::ALL.into_iter().find(|quantity| quantity.name().eq_ignore_ascii_case(name));
        if found.is_none() {
            self.problem(element, format!("the quantity is `{}`", shown(name)), format!("allowed: {}", names()));
        }
        found
    }

    fn number(&mut self, element: Node, text: &str) -> Option<f64> {
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Some(value),
            Ok(_) => {
                self.problem(element, format!("`{}` is not a finite number", shown(text)), "leave the row out, or give a finite value");
                None
            }
            Err(_) => {
                self.problem(element, format!("`{}` is not a number", shown(text)), "give a number such as `0.42` or `4.2e-1`");
                None
            }
        }
    }

    fn rows(&mut self, node: Node<'d, 'd>) -> (Vec<f64>, Vec<f64>) {
        let (mut wavelengths_nm, mut values): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
        let mut rows = 0;
        for element in node.children().filter(|child| child.tag_name().name() == "SpectralData") {
            rows += 1;
            let Some(wavelength) = element.attribute("wavelength") else {
                self.problem(element, "the row has no wavelength", "write `<SpectralData wavelength=\"555\">0.42</SpectralData>`");
                continue;
            };
            if let Some(inner) = element.children().find(Node::is_element) {
                self.problem(inner, format!("an element `{}` within a row", shown(inner.tag_name().name())), "a row holds one number");
            }
            let wavelength_nm = self.number(element, wavelength.trim());
            let value = self.number(element, text_of(element));
            if let Some(value) = value.filter(|value| *value < 0.0) {
                self.problem(element, format!("the value {value} is negative"), "values must be 0 or above here");
            }
            let (Some(wavelength_nm), Some(value)) = (wavelength_nm, value) else { continue };
            let previous_nm = wavelengths_nm.last().copied();
            if wavelength_nm <= 0.0 {
                self.problem(element, format!("the wavelength {wavelength_nm} nm is not above 0"), "wavelengths are in nm");
            } else if previous_nm == Some(wavelength_nm) {
                self.problem(element, format!("{wavelength_nm} nm is there twice"), "keep one of the two rows");
            } else if let Some(previous_nm) = previous_nm.filter(|previous| wavelength_nm < *previous) {
                self.problem(element, format!("{wavelength_nm} nm follows {previous_nm} nm"), "sort the rows by wavelength, rising");
            }
            wavelengths_nm.push(wavelength_nm);
            values.push(value);
        }
        let longest = wavelengths_nm.iter().copied().fold(0.0, f64::max);
        if longest > 0.0 && longest < 10.0 {
            let message = format!("all wavelengths are below 10 nm (the longest is {longest})");
            self.problem(node, message, "IES TM-27 has wavelengths in nm: multiply micrometres by 1000, metres by 1e9");
        }
        if rows < 2 {
            let message = format!("there are {rows} rows `SpectralData`");
            self.problem(node, message, "a curve needs at least two: `<SpectralData wavelength=\"555\">0.42</SpectralData>`");
        }
        (wavelengths_nm, values)
    }
}

/// The names of all quantities.
fn names() -> String {
    SpectralQuantity::ALL.map(SpectralQuantity::name).join(", ")
}
