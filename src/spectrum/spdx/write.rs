//! From a spectrum to XML.

use std::fmt::Write;

use super::{HEADER, Spdx};

/// The document as text. Numbers are written so that they are read back bit by bit; characters that XML cannot hold become blanks.
/// Elements that the format asks for are written empty if they are not given.
pub fn write(spectrum: &Spdx) -> String {
    let mut text =
        String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<IESTM2714 xmlns=\"iestm2714\" version=\"1.0\">\n\t<Header>\n");
    let mut element = |name: &str, value: &str| {
        let _ = writeln!(text, "\t\t<{name}>{}</{name}>", escaped(value));
    };
    for ((name, _, asked_for), value) in HEADER.iter().zip(spectrum.header.fields()) {
        match value {
            Some(value) => element(name, value),
            None if *asked_for => element(name, ""),
            None => {}
        }
    }
    text.push_str("\t</Header>\n\t<SpectralDistribution>\n");
    let mut element = |name: &str, value: &str| {
        let _ = writeln!(text, "\t\t<{name}>{}</{name}>", escaped(value));
    };
    element("SpectralQuantity", spectrum.quantity.name());
    let geometries = [("ReflectionGeometry", &spectrum.reflection_geometry), ("TransmissionGeometry", &spectrum.transmission_geometry)];
    for (name, geometry) in geometries {
        if let Some(geometry) = geometry {
            element(name, geometry);
        }
    }
    if let Some(width_nm) = spectrum.bandwidth_fwhm_nm {
        element("BandwidthFWHM", &width_nm.to_string());
    }
    if let Some(corrected) = spectrum.bandwidth_corrected {
        element("BandwidthCorrected", if corrected { "true" } else { "false" });
    }
    for (nm, value) in spectrum.wavelengths_nm.iter().zip(&spectrum.values) {
        let _ = writeln!(text, "\t\t<SpectralData wavelength=\"{nm}\">{value:e}</SpectralData>");
    }
    text.push_str("\t</SpectralDistribution>\n</IESTM2714>\n");
    text
}

fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '\t' | '\n' => escaped.push(character),
            // A carriage return as it stands is read as a line feed.
            '\r' => escaped.push_str("&#13;"),
            '\u{fffe}' | '\u{ffff}' => escaped.push(' '),
            _ if character.is_control() && character < ' ' => escaped.push(' '),
            _ => escaped.push(character),
        }
    }
    escaped
}
