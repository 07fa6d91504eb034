//! Chromaticity diagrams, colours of wavelengths and plots of sensors: what the pictures say is what the numbers are.

#![cfg(feature = "plot")]

use std::fs;
use std::sync::Arc;

use etendue::observer::Matching;
use etendue::observer::colour::spectral_locus;
use etendue::report::plot::chromaticity::{Contents, Diagram, DisplayGamut, chart};
use etendue::report::plot::{self, Chart, Size, Style, Theme, wavelength_colour};
use etendue::scene::{MemoryFiles, sensor_from_file};
use etendue::sensor::Sensor;
use etendue::spectrum::library;
use resvg::usvg;

const SIZES: [Size; 3] = [Size::Paper, Size::Column, Size::Slide];

fn contents(diagram: Diagram, observer: Matching, size: Size) -> Contents {
    Contents { size, ..Contents::new(diagram, observer) }
}

fn busy(diagram: Diagram, size: Size) -> Contents {
    let spectra = ["LED-B3", "FL11"].map(|name| (name.to_owned(), library::density(name).expect("of the library"))).to_vec();
    let gamuts = vec![DisplayGamut::named("sRGB").expect("a standard gamut")];
    Contents { spectra, gamuts, ..contents(diagram, Matching::Cie1931, size) }
}

fn picture(chart: &Chart, size: Size, theme: Theme) -> String {
    plot::svg(chart, &Style { theme, size }).expect("a picture")
}

fn sensor(name: &str, files: &[&str]) -> Sensor {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/sensors");
    let text = |file: &str| fs::read_to_string(format!("{root}/{file}")).expect("a file of the shelf");
    let files = files.iter().chain([&name]).fold(MemoryFiles::new(), |all, file| all.with(&format!("sensors/{file}"), text(file)));
    sensor_from_file(&format!("sensors/{name}"), &files, None).expect("a sensor")
}

fn attribute(node: roxmltree::Node<'_, '_>, name: &str) -> f64 {
    node.attribute(name).and_then(|value| value.parse().ok()).unwrap_or_else(|| panic!("no number {name} in {node:?}"))
}

#[test]
fn white_points_stand_where_their_coordinates_are() {
    // CIE 015:2018, tables T.3 and of illuminant E.
    let tabulated = [("A", 0.44758, 0.40745), ("D50", 0.34567, 0.35851), ("D65", 0.31272, 0.32903), ("E", 0.33333, 0.33333)];
    for (size, diagram) in SIZES.into_iter().flat_map(|size| [(size, Diagram::Xy), (size, Diagram::UvPrime)]) {
        let svg = picture(&chart(&contents(diagram, Matching::Cie1931, size)).expect("a diagram"), size, Theme::Light);
        let document = roxmltree::Document::parse(&svg).expect("well-formed");
        // The axes by their labels: those of x are centred on their tick, those of y end left of it, half a capital below.
        let label = |text: &str, anchor: &str| {
            let mut found = document.descendants().filter(|n| n.has_tag_name("text") && n.attribute("text-anchor") == Some(anchor));
            let node = found.find(|node| node.text() == Some(text)).unwrap_or_else(|| panic!("no label {text}"));
            [attribute(node, "x"), attribute(node, "y") - 0.36 * attribute(node, "font-size")]
        };
        let (x0, x1, y0, y1) = (label("0.0", "middle")[0], label("0.5", "middle")[0], label("0.0", "end")[1], label("0.5", "end")[1]);
        let circles: Vec<[f64; 2]> = document
            .descendants()
            .filter(|node| node.has_tag_name("circle"))
            .map(|node| [attribute(node, "cx") / 16.0, attribute(node, "cy") / 16.0])
            .collect();
        for (name, x, y) in tabulated {
            let d = 3.0 - 2.0 * x + 12.0 * y;
            let [first, second] = if diagram == Diagram::Xy { [x, y] } else { [4.0 * x / d, 9.0 * y / d] };
            let expected = [x0 + (x1 - x0) * first / 0.5, y0 + (y1 - y0) * second / 0.5];
            let nearest = circles.iter().map(|c| (c[0] - expected[0]).hypot(c[1] - expected[1])).fold(f64::INFINITY, f64::min);
            assert!(nearest < 0.5, "{name} is {nearest} px away in {diagram:?}, {size:?}");
        }
    }
}

#[test]
fn ticks_stand_on_the_locus_and_point_outwards() {
    let observers = [Matching::Cie1931, Matching::Cie1964, Matching::Cie2015TwoDegree, Matching::Cie2015TenDegree];
    for (observer, diagram) in observers.into_iter().flat_map(|o| [(o, Diagram::Xy), (o, Diagram::UvPrime)]) {
        let drawn = chart(&contents(diagram, observer, Size::Paper)).expect("a diagram");
        let curve = |label: &str| &drawn.curves.iter().find(|curve| curve.label == label).expect("a curve").points;
        let locus: Vec<[f64; 2]> =
            spectral_locus(&observer.functions(), 380.0, 780.0, 1.0).iter().map(|point| diagram.place(&point.chromaticity)).collect();
        let distance = |p: &[f64; 2], q: &[f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
        let (ticks, outline) = (curve("Wavelengths"), curve("Spectral locus"));
        assert!(ticks.len() > 60, "{} ticks", ticks.len() / 3);
        let white = [0.25, 0.4];
        for tick in ticks.chunks(3) {
            assert!(locus.iter().any(|point| distance(point, &tick[0]) < 1e-12), "{observer:?} {diagram:?}: {:?}", tick[0]);
            assert!(distance(&tick[1], &white) > distance(&tick[0], &white), "{observer:?} {diagram:?}: {tick:?}");
        }
        assert!(outline.iter().all(|point| locus.iter().any(|other| distance(point, other) < 1e-12)));
    }
}

/// Boxes of the letters of every text.
fn ink(svg: &str) -> Vec<(String, usvg::Rect)> {
    let mut fonts = usvg::fontdb::Database::new();
    for weight in ["Regular", "Medium"] {
        fonts.load_font_data(fs::read(format!("{}/assets/Roboto-{weight}.ttf", env!("CARGO_MANIFEST_DIR"))).expect("the font"));
    }
    let options = usvg::Options { fontdb: Arc::new(fonts), font_family: "Roboto".to_owned(), ..usvg::Options::default() };
    let tree = usvg::Tree::from_str(svg, &options).expect("a tree");
    fn walk(group: &usvg::Group, found: &mut Vec<(String, usvg::Rect)>) {
        for node in group.children() {
            match node {
                usvg::Node::Group(inner) => walk(inner, found),
                usvg::Node::Text(text) => {
                    let words = text.chunks().iter().map(|chunk| chunk.text()).collect::<Vec<_>>().concat();
                    found.push((words, text.flattened().abs_bounding_box()));
                }
                _ => {}
            }
        }
    }
    let mut found = Vec::new();
    walk(tree.root(), &mut found);
    found
}

#[test]
fn no_text_overlaps_another_or_leaves_the_picture() {
    let mut charts: Vec<(Chart, Size)> = Vec::new();
    for size in SIZES {
        for diagram in [Diagram::Xy, Diagram::UvPrime] {
            charts.push((chart(&busy(diagram, size)).expect("a diagram"), size));
            charts.push((chart(&contents(diagram, Matching::Cie2015TenDegree, size)).expect("a diagram"), size));
        }
        let skewed = sensor("directional-phi-meter.ron", &["directional-phi/response.csv"]);
        let class_b = sensor("class-b-lux-meter.ron", &["class-b/responsivity.csv", "class-b/directional.csv"]);
        charts.push((plot::polar::chart(std::slice::from_ref(&skewed)).expect("a plot"), size));
        charts.push((plot::sensor::directional(&[skewed]).expect("a plot"), size));
        charts.push((plot::sensor::deviation(std::slice::from_ref(&class_b)).expect("a plot"), size));
        charts.push((plot::sensor::responsivity(&[class_b]).expect("a plot"), size));
    }
    for (chart, size) in charts {
        let svg = picture(&chart, size, Theme::Dark);
        assert!(svg.len() < 300_000, "{}: {} bytes", chart.title, svg.len());
        let document = roxmltree::Document::parse(&svg).expect("well-formed");
        let view = document.root_element().attribute("viewBox").expect("a view");
        let view: Vec<f32> = view.split(' ').map(|side| side.parse().expect("a number")).collect();
        let texts = ink(&svg);
        assert!(texts.len() > 10, "{}", texts.len());
        for (index, (text, area)) in texts.iter().enumerate() {
            let inside = area.left() >= 0.0 && area.top() >= 0.0 && area.right() <= view[2] && area.bottom() <= view[3];
            assert!(inside, "`{text}` of {} leaves the picture at {size:?}", chart.title);
            for (other, beside) in &texts[index + 1..] {
                let apart = area.right() <= beside.left()
                    || beside.right() <= area.left()
                    || area.bottom() <= beside.top()
                    || beside.bottom() <= area.top();
                assert!(apart, "`{text}` and `{other}` of {} at {size:?}", chart.title);
            }
        }
    }
}

#[test]
fn every_spectrum_and_white_point_is_named() {
    for (size, diagram) in SIZES.into_iter().flat_map(|size| [(size, Diagram::Xy), (size, Diagram::UvPrime)]) {
        let svg = picture(&chart(&busy(diagram, size)).expect("a diagram"), size, Theme::Light);
        let texts = ink(&svg);
        for name in ["A", "D50", "D65", "E", "LED-B3", "FL11", "sRGB", "520", "600", "700"] {
            assert!(texts.iter().any(|(text, _)| text == name), "no `{name}` in {diagram:?} at {size:?}");
        }
    }
}

#[test]
fn unfit_requests_are_told() {
    assert!(chart(&contents(Diagram::Xy, Matching::WrightGuild1931, Size::Paper)).unwrap_err().to_string().contains("CIE 1931"));
    assert!(chart(&Contents { observer: Matching::Cie1964, ..busy(Diagram::Xy, Size::Paper) }).unwrap_err().to_string().contains("sRGB"));
    assert!(DisplayGamut::named("sRBG").unwrap_err().to_string().contains("sRGB, Display P3"));
    let dark = etendue::spectrum::Density::flat(1000.0, 1100.0, 1.0).expect("a spectrum");
    let infrared = Contents { spectra: vec![("infrared".to_owned(), dark)], ..contents(Diagram::Xy, Matching::Cie1931, Size::Paper) };
    assert!(chart(&infrared).unwrap_err().to_string().contains("infrared"));
    let unknown = Contents { white_points: vec!["D66".to_owned()], ..contents(Diagram::Xy, Matching::Cie1931, Size::Paper) };
    assert!(chart(&unknown).unwrap_err().to_string().contains("D65"));
}

/// OKLab (Ottosson 2020) of sRGB bytes.
fn oklab(bytes: [u8; 3]) -> [f64; 3] {
    let [r, g, b] = bytes.map(|byte| {
        let v = f64::from(byte) / 255.0;
        if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
    });
    let l = (0.412_221_470_8 * r + 0.536_332_536_3 * g + 0.051_445_992_9 * b).cbrt();
    let m = (0.211_903_498_2 * r + 0.680_699_545_1 * g + 0.107_396_956_6 * b).cbrt();
    let s = (0.088_302_461_9 * r + 0.281_718_837_6 * g + 0.629_978_700_5 * b).cbrt();
    [
        0.210_454_255_3 * l + 0.793_617_785_0 * m - 0.004_072_046_8 * s,
        1.977_998_495_1 * l - 2.428_592_205_0 * m + 0.450_593_709_9 * s,
        0.025_904_037_1 * l + 0.782_771_766_2 * m - 0.808_675_766_0 * s,
    ]
}

#[test]
fn neighbouring_wavelengths_have_neighbouring_colours() {
    let lab: Vec<[f64; 3]> = (380..=780).map(|nm| oklab(wavelength_colour::colour(f64::from(nm)))).collect();
    let step = |pair: &[[f64; 3]]| (0..3).map(|i| (pair[1][i] - pair[0][i]).powi(2)).sum::<f64>().sqrt();
    // A byte's rounding is up to 0.012 in the darkest colours.
    let largest = lab.windows(2).map(step).fold(0.0, f64::max);
    assert!(largest < 0.03, "{largest}");
    // Over 5 nm rounding counts for less: the speed is that of the curve itself.
    let fast = lab.iter().zip(&lab[5..]).map(|(a, b)| step(&[*a, *b]) / 5.0).fold(0.0, f64::max);
    assert!(fast < 0.02, "{fast}");
}

#[test]
fn the_radius_of_the_polar_plot_is_the_response_times_the_cosine() {
    let sensors = [sensor("class-b-lux-meter.ron", &["class-b/responsivity.csv", "class-b/directional.csv"])];
    let polar = plot::polar::chart(&sensors).expect("a plot");
    let curve = polar.curves.iter().find(|curve| curve.label == sensors[0].title).expect("its curve");
    let theta = 60.0_f64.to_radians();
    let response = |theta: f64| sensors[0].acceptance.at(theta.cos(), theta.sin(), 0.0);
    let expected = response(theta) * theta.cos() / response(0.0);
    let side = |sign: f64| curve.points.iter().find(|p| (p[0].atan2(p[1]) - sign * theta).abs() < 1e-9).expect("a point at 60°");
    for sign in [-1.0, 1.0] {
        let [x, y] = *side(sign);
        assert!((x.hypot(y) - expected).abs() < 1e-12, "{} instead of {expected}", x.hypot(y));
    }
    assert!((expected - 0.5).abs() > 1e-4, "an ideal sensor would prove nothing");
}

#[test]
fn a_response_that_depends_on_the_azimuth_has_several_cuts() {
    let sensors = [sensor("directional-phi-meter.ron", &["directional-phi/response.csv"])];
    let drawn = plot::sensor::directional(&sensors).expect("a plot");
    let cuts: Vec<&str> = drawn.curves.iter().map(|curve| curve.label.as_str()).filter(|label| label.starts_with("φ")).collect();
    assert_eq!(cuts, ["φ = 0°", "φ = 45°", "φ = 90°", "φ = 135°"]);
    for (curve, phi_deg) in drawn.curves[1..].iter().zip([0.0_f64, 45.0, 90.0, 135.0]) {
        for [deg, response] in curve.points.iter().filter(|point| point[0].abs() < 89.0) {
            let (theta, phi) = (deg.abs().to_radians(), (if *deg < 0.0 { phi_deg + 180.0 } else { phi_deg }).to_radians());
            let expected = sensors[0].acceptance.at(theta.cos(), theta.sin(), phi) * theta.cos() / sensors[0].acceptance.at(1.0, 0.0, 0.0);
            assert!((response - expected).abs() < 1e-9, "{deg}° in φ = {phi_deg}°: {response} instead of {expected}");
        }
    }
}

#[test]
fn a_white_point_that_is_also_a_spectrum_stands_there_once() {
    let spectra = vec![("D65".to_owned(), library::density("D65").expect("of the library"))];
    let chart = chart(&Contents { spectra, ..Contents::new(Diagram::Xy, Matching::Cie1931) }).expect("a diagram");
    let names: Vec<&str> = chart.points.iter().map(|point| point.label.as_str()).collect();
    assert_eq!(names, ["A", "D50", "E", "D65"]);
}
