//! Lines and areas through plotters' SVG backend.
//!
//! Its coordinates are integers, so everything is drawn at sixteen times its size and scaled back by the group around it. Each stroke
//! or area is a fragment of its own: dashes and gradients, which the backend does not know, are attributes of the group.

use std::fmt::Write as _;

use plotters::prelude::{Circle, DrawingArea, IntoDrawingArea, PathElement, Polygon, RGBAColor, SVGBackend, ShapeStyle};

use super::chart::Dash;
use super::error::PlotError;
use super::polyline::Rectangle;
use super::style::hex;
use super::text::number;

/// Steps of the backend's grid in a px.
pub(super) const FINENESS: f64 = 16.0;

/// The elements of a picture, back to front.
#[derive(Debug)]
pub(super) struct Canvas {
    size: (u32, u32),
    /// What has been drawn.
    pub(super) elements: String,
}

/// Colour and width of a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stroke {
    pub(super) colour: [u8; 3],
    pub(super) width_px: f64,
    pub(super) dash: Dash,
}

/// What an area is filled with.
#[derive(Debug, Clone, Copy)]
pub(super) enum Paint<'a> {
    Plain([u8; 3]),
    /// A gradient by its name.
    Gradient(&'a str),
}

fn fine(point: &[f64; 2]) -> (i32, i32) {
    ((point[0] * FINENESS).round() as i32, (point[1] * FINENESS).round() as i32)
}

fn shape(colour: [u8; 3], opacity: f64, filled: bool, width_px: f64) -> ShapeStyle {
    let color = RGBAColor(colour[0], colour[1], colour[2], opacity);
    ShapeStyle { color, filled, stroke_width: (width_px * FINENESS).round().max(1.0) as u32 }
}

impl Canvas {
    pub(super) fn new(width: f64, height: f64) -> Self {
        let side = |px: f64| (px * FINENESS).ceil() as u32;
        Self { size: (side(width), side(height)), elements: String::new() }
    }

    /// What `draw` draws, without the document around it.
    fn fragment<F>(&self, draw: F) -> Result<String, PlotError>
    where
        F: FnOnce(&DrawingArea<SVGBackend<'_>, plotters::coord::Shift>) -> Result<(), String>,
    {
        let mut document = String::new();
        {
            let area = SVGBackend::with_string(&mut document, self.size).into_drawing_area();
            draw(&area).map_err(PlotError::Drawing)?;
            area.present().map_err(|e| PlotError::Drawing(e.to_string()))?;
        }
        let inner = document.split_once(">\n").and_then(|(_, rest)| rest.rsplit_once("</svg>")).map(|(inner, _)| inner);
        // A space before the closing quote of a list of points and an opacity of one say nothing.
        inner
            .map(|inner| inner.replace(" \"/>", "\"/>").replace(" opacity=\"1\"", ""))
            .ok_or_else(|| PlotError::Drawing("no document".to_owned()))
    }

    fn group(&mut self, attributes: &str, inner: &str) {
        // Writing to a string cannot fail.
        let _ = write!(self.elements, "<g transform=\"scale({})\"{attributes}>\n{inner}</g>\n", 1.0 / FINENESS);
    }

    /// Lines of one colour.
    pub(super) fn lines(&mut self, lines: &[Vec<[f64; 2]>], stroke: Stroke) -> Result<(), PlotError> {
        let style = shape(stroke.colour, 1.0, false, stroke.width_px);
        let inner = self.fragment(|area| {
            lines.iter().filter(|line| line.len() > 1).try_for_each(|line| {
                area.draw(&PathElement::new(line.iter().map(fine).collect::<Vec<_>>(), style)).map_err(|e| e.to_string())
            })
        })?;
        let unit = stroke.width_px * FINENESS;
        let dashes = match stroke.dash {
            Dash::Solid => String::new(),
            Dash::Dashed => format!(" stroke-dasharray=\"{} {}\"", number(3.4 * unit), number(2.6 * unit)),
            Dash::Dotted => format!(" stroke-dasharray=\"0 {}\"", number(2.4 * unit)),
        };
        if !inner.is_empty() {
            self.group(&format!(" stroke-linejoin=\"round\" stroke-linecap=\"round\"{dashes}"), &inner);
        }
        Ok(())
    }

    /// Straight lines of the grid, which need no round ends.
    pub(super) fn hairs(&mut self, lines: &[Vec<[f64; 2]>], colour: [u8; 3], width_px: f64) -> Result<(), PlotError> {
        let style = shape(colour, 1.0, false, width_px);
        let inner = self.fragment(|area| {
            lines.iter().try_for_each(|line| {
                area.draw(&PathElement::new(line.iter().map(fine).collect::<Vec<_>>(), style)).map_err(|e| e.to_string())
            })
        })?;
        if !inner.is_empty() {
            self.group("", &inner);
        }
        Ok(())
    }

    /// A filled polygon.
    pub(super) fn area(&mut self, points: &[[f64; 2]], paint: Paint<'_>, opacity: f64) -> Result<(), PlotError> {
        if points.len() < 3 {
            return Ok(());
        }
        let colour = if let Paint::Plain(colour) = paint { colour } else { [0, 0, 0] };
        let style = shape(colour, opacity, true, 1.0);
        let mut inner =
            self.fragment(|area| area.draw(&Polygon::new(points.iter().map(fine).collect::<Vec<_>>(), style)).map_err(|e| e.to_string()))?;
        if let Paint::Gradient(name) = paint {
            inner = inner.replace(&format!("fill=\"{}\"", hex(colour)), &format!("fill=\"url(#{name})\""));
        }
        self.group("", &inner);
        Ok(())
    }

    /// A rectangle.
    pub(super) fn rectangle(&mut self, area: &Rectangle, paint: Paint<'_>, opacity: f64) -> Result<(), PlotError> {
        let Rectangle { left, top, right, bottom } = *area;
        self.area(&[[left, top], [right, top], [right, bottom], [left, bottom]], paint, opacity)
    }

    /// A disc.
    pub(super) fn disc(&mut self, at: [f64; 2], radius_px: f64, colour: [u8; 3]) -> Result<(), PlotError> {
        let style = shape(colour, 1.0, true, 1.0);
        let inner = self.fragment(|area| area.draw(&Circle::new(fine(&at), radius_px * FINENESS, style)).map_err(|e| e.to_string()))?;
        self.group("", &inner);
        Ok(())
    }
}

/// A horizontal gradient in the canvas's own steps, from `left` to `right` px: (place 0..1, colour, opacity), rising.
pub(super) fn gradient(name: &str, left: f64, right: f64, stops: &[(f64, [u8; 3], f64)]) -> String {
    let (from, to) = (number(left * FINENESS), number(right * FINENESS));
    let mut out = format!("<linearGradient id=\"{name}\" gradientUnits=\"userSpaceOnUse\" x1=\"{from}\" y1=\"0\" x2=\"{to}\" y2=\"0\">\n");
    for (place, colour, opacity) in stops {
        let faint = if *opacity < 1.0 { format!(" stop-opacity=\"{}\"", number(*opacity)) } else { String::new() };
        let _ = writeln!(out, "<stop offset=\"{:.4}\" stop-color=\"{}\"{faint}/>", place, hex(*colour));
    }
    out + "</linearGradient>\n"
}
