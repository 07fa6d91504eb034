//! Chromaticity diagrams: the colours of all lights at one luminance, of one observer.
//!
//! ```text
//! x = X / (X + Y + Z),  y = Y / (X + Y + Z)          u′ = 4X / (X + 15Y + 3Z),  v′ = 9Y / (X + 15Y + 3Z)
//! ```
//!
//! | what is drawn | from |
//! |---|---|
//! | spectral locus, ticks outwards along its normal | the observer's functions, exactly, every nm |
//! | purple line | the ends of the drawn locus, 380 nm and 700 nm |
//! | Planckian locus, short lines of equal correlated temperature | `PlanckianLocus`; the lines are normal to it in CIE 1960 u, v |
//! | daylight locus | spectra of the D series, 4000 K to 25 000 K |
//! | white points, spectra | exact integrals |
//! | gamuts | chromaticities of the primaries |
//!
//! Both axes have the same scale. The colours inside are for orientation (`shade`).

mod gamut;
mod labels;
mod loci;
mod shade;
mod wavelengths;

pub use gamut::DisplayGamut;

use self::labels::Names;
use super::PlotError;
use super::chart::{Axis, Chart, Ink, Point};
use super::style::Size;
use crate::observer::Matching;
use crate::observer::colour::{Chromaticity, Tristimulus, white_point};
use crate::spectrum::{Density, Factor};

/// Which two coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Diagram {
    /// CIE x, y.
    Xy,
    /// CIE 1976 u′, v′: equal distances look about equally different.
    UvPrime,
}

impl Diagram {
    /// Where a chromaticity stands.
    pub fn place(self, chromaticity: &Chromaticity) -> [f64; 2] {
        match self {
            Self::Xy => [chromaticity.x, chromaticity.y],
            Self::UvPrime => {
                let (u, v) = chromaticity.uv_prime();
                [u, v]
            }
        }
    }

    /// What stands at a place.
    pub fn chromaticity(self, [first, second]: [f64; 2]) -> Chromaticity {
        match self {
            Self::Xy => Chromaticity { x: first, y: second },
            Self::UvPrime => Chromaticity::from_uv_prime(first, second),
        }
    }

    /// Lower and upper end of both axes, with room for the wavelengths around the locus.
    fn ranges(self) -> [(f64, f64); 2] {
        match self {
            Self::Xy => [(-0.075, 0.815), (-0.06, 0.91)],
            Self::UvPrime => [(-0.055, 0.69), (-0.045, 0.655)],
        }
    }

    fn symbols(self) -> [&'static str; 2] {
        match self {
            Self::Xy => ["x", "y"],
            Self::UvPrime => ["u′", "v′"],
        }
    }
}

/// What a diagram shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Contents {
    /// Its coordinates.
    pub diagram: Diagram,
    /// The observer; one of the four with x̄, ȳ, z̄.
    pub observer: Matching,
    /// White points by their names in the library.
    pub white_points: Vec<String>,
    /// Spectra with their labels.
    pub spectra: Vec<(String, Density)>,
    /// Gamuts of displays.
    pub gamuts: Vec<DisplayGamut>,
    /// Size of the picture; how many wavelengths are written depends on it.
    pub size: Size,
}

impl Contents {
    /// A diagram of an observer with the white points A, D50, D65 and E, for paper.
    pub fn new(diagram: Diagram, observer: Matching) -> Self {
        let white_points = ["A", "D50", "D65", "E"].map(str::to_owned).to_vec();
        Self { diagram, observer, white_points, spectra: Vec::new(), gamuts: Vec::new(), size: Size::Paper }
    }
}

/// The diagram. Errors if the observer has no x̄, ȳ, z̄, if the library does not have a white point, if the observer does not see a
/// spectrum, or if a gamut is known for another observer only.
///
/// ```
/// use etendue::observer::Matching;
/// use etendue::report::plot::chromaticity::{Contents, Diagram, chart};
///
/// let chart = chart(&Contents::new(Diagram::Xy, Matching::Cie1931))?;
/// let d65 = chart.points.iter().find(|point| point.label == "D65").expect("a white point");
/// assert!((d65.at[0] - 0.3127).abs() < 1e-4 && (d65.at[1] - 0.3290).abs() < 1e-4);
/// # Ok::<(), etendue::report::plot::PlotError>(())
/// ```
pub fn chart(contents: &Contents) -> Result<Chart, PlotError> {
    let Contents { diagram, observer, .. } = *contents;
    let (year, field, subscript) = match observer {
        Matching::Cie1931 => ("CIE 1931", "2° standard observer", ""),
        Matching::Cie1964 => ("CIE 1964", "10° standard observer", "_{10}"),
        Matching::Cie2015TwoDegree => ("CIE 2015", "2° observer from cone fundamentals", "_{F}"),
        Matching::Cie2015TenDegree => ("CIE 2015", "10° observer from cone fundamentals", "_{F,10}"),
        other => {
            let what = format!("`{}` has no x̄, ȳ, z̄; allowed: CIE 1931, CIE 1964, CIE 2015 2 degree, CIE 2015 10 degree", other.title());
            return Err(PlotError::Request { what });
        }
    };
    let functions = observer.functions();
    let [x, y] = [0, 1].map(|i| {
        let (from, to) = diagram.ranges()[i];
        let ticks = (0..).map(|tenth| 0.1 * f64::from(tenth)).take_while(|value| *value < to - 0.005).map(|v| (v, format!("{v:.1}")));
        Axis { ticks: ticks.collect(), ..Axis::linear(&format!("{}{subscript}", diagram.symbols()[i]), "1", from, to) }
    });
    let (title, subtitle) = match diagram {
        Diagram::Xy => (format!("{year} chromaticity diagram"), format!("{field}; ")),
        Diagram::UvPrime => ("CIE 1976 uniform chromaticity diagram".to_owned(), format!("{year}, {field}; ")),
    };
    let subtitle = subtitle + "wavelengths in nm, correlated colour temperatures in K; dotted: daylight, 4000 K to 25\u{202f}000 K";
    let mut chart = Chart::new(&title, &subtitle, x, y);
    chart.equal_scale = true;
    chart.proportion = Some(if diagram == Diagram::Xy { 1.2 } else { 1.06 });

    let em = em_of_plane(contents.size, diagram);
    let outline = loci::spectral(diagram, &functions);
    chart.shade = Some(shade::shade(diagram, outline.clone()));
    gamut::draw(&mut chart, contents)?;
    let crossings = loci::draw(&mut chart, diagram, &functions);
    wavelengths::draw(&mut chart, diagram, &functions, outline.clone(), em);
    points(&mut chart, contents, &functions)?;

    // What matters most is written first.
    let mut names = Names::new(&chart, &outline, em);
    for index in (0..chart.points.len()).rev() {
        let (name, at) = (chart.points[index].label.clone(), chart.points[index].at);
        // Without room inside, the name is written wherever there is some.
        chart.points[index].written = !names.beside_point(&mut chart, &name, at);
    }
    for (text, [upper, lower]) in &crossings {
        let up = loci::unit([upper[0] - lower[0], upper[1] - lower[1]]);
        let _ = names.at_end(&mut chart, text, *upper, up) || names.at_end(&mut chart, text, *lower, up.map(|c| -c));
    }
    if let Some([_, hottest]) = crossings.iter().find(|(text, _)| text == "∞").map(|(_, ends)| ends) {
        names.beside_point(&mut chart, "Planckian locus", *hottest);
    }
    Ok(chart)
}

/// White points and spectra.
fn points(chart: &mut Chart, contents: &Contents, functions: &[Factor; 3]) -> Result<(), PlotError> {
    let (diagram, observer) = (contents.diagram, contents.observer.title());
    // A spectrum that is one of the white points is drawn and named once.
    let also_spectrum = |name: &String| contents.spectra.iter().any(|(label, _)| label == name);
    for name in contents.white_points.iter().filter(|name| !also_spectrum(name)) {
        let unseen = || PlotError::Request { what: format!("{observer} does not see `{name}`") };
        let white = white_point(name, functions).map_err(|e| PlotError::Request { what: e.to_string() })?.ok_or_else(unseen)?;
        let at = diagram.place(&white);
        chart.points.push(Point { label: name.clone(), at, ink: Ink::OnShade, radius: 0.75, written: false });
    }
    for (label, density) in &contents.spectra {
        let unseen = || PlotError::Request { what: format!("`{label}` has no chromaticity: {observer} does not see it") };
        let at = diagram.place(&Tristimulus::of(density, functions).chromaticity().ok_or_else(unseen)?);
        chart.points.push(Point { label: label.clone(), at, ink: Ink::Fixed(SPECTRUM), radius: 1.15, written: false });
    }
    Ok(())
}

/// Colour of the points of spectra, which shows on all colours of the shade.
const SPECTRUM: [u8; 3] = [24, 26, 32];

/// About how large the text is in units of the plane: what is left of the picture beside the texts around the frame.
fn em_of_plane(size: Size, diagram: Diagram) -> f64 {
    let [span_x, span_y] = diagram.ranges().map(|(from, to)| to - from);
    // Sizes and texts of the style, in px.
    let (width, height, em) = match size {
        Size::Paper => (642.0, f64::INFINITY, 10.7),
        Size::Column => (321.0, f64::INFINITY, 9.3),
        Size::Slide => (1280.0, 720.0, 20.0),
        Size::Custom { width_px, height_px } => {
            let (w, h) = (f64::from(width_px), f64::from(height_px));
            (w, h, (0.0205 * (w * h).sqrt()).max(8.0))
        }
    };
    // The frame leaves about 5 lines at the sides and 10 above and below.
    let scale = ((width - 5.0 * em) / span_x).min((height - 10.5 * em) / span_y);
    if scale > 0.0 { em / scale } else { 0.1 }
}
