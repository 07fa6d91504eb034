//! Every kind of plot, in both themes and all sizes: well-formed, labelled, nothing on top of anything else or outside, and the numbers
//! are those of the functions it shows.
#![cfg(feature = "plot")]

use std::collections::BTreeMap;

use etendue::observer::{Cones, Efficiency, Individual, Matching};
use etendue::report::plot::chart::{Axis, Chart, Curve, Ink, Point, Scale};
use etendue::report::plot::chromaticity::{Contents, Diagram};
use etendue::report::plot::{
    self, PlotError, Size, Style, Theme, blackbody, chromaticity, cmf, cones, pigments, reflectance, spectrum, v_lambda,
};
use etendue::spectrum::{Density, Factor, Line, library};
use resvg::usvg::roxmltree::{Document, Node};

fn style(theme: Theme, size: Size) -> Style {
    Style { theme, size }
}

fn individual(age_yr: f64, field_deg: f64) -> Cones {
    Cones::Individual(Individual { age_yr, field_deg })
}

fn spectra(names: &[&str], scaling: spectrum::Scaling) -> Chart {
    let items = names.iter().map(|name| spectrum::Item { name: (*name).to_owned(), density: library::density(name).expect(name) });
    let unit = "1/nm (relative)".to_owned();
    let choice = spectrum::Choice { items: items.collect(), scaling, unit, from_nm: 380.0, to_nm: 780.0 };
    spectrum::chart(&choice).expect("drawable")
}

fn mercury() -> Chart {
    let lines = [(404.66, 1.0), (435.83, 2.0), (546.07, 3.0), (576.96, 1.5), (579.07, 1.6)];
    let lines = lines.map(|(wavelength_nm, power)| Line { wavelength_nm, power });
    let item = spectrum::Item { name: "mercury".to_owned(), density: Density::lines_only(&lines).expect("lines") };
    let choice =
        spectrum::Choice { items: vec![item], scaling: spectrum::Scaling::AsGiven, unit: "W/nm".to_owned(), from_nm: 380.0, to_nm: 780.0 };
    spectrum::chart(&choice).expect("drawable")
}

fn patches(names: &str) -> Chart {
    let entries = library::set(names).expect(names);
    let items: Vec<_> = entries
        .iter()
        .map(|entry| reflectance::Item { name: entry.column.clone(), factor: library::factor(&entry.name).expect("a reflectance") })
        .collect();
    reflectance::chart(names, &items).expect("drawable")
}

/// One or more charts of every kind.
fn charts() -> Vec<(&'static str, Chart)> {
    let functions = Efficiency::ALL.to_vec();
    let v = |choice: &v_lambda::Choice| v_lambda::chart(choice).expect("V");
    let c = |sets: Vec<Cones>, quantal, log| cones::chart(&cones::Choice { sets, quantal, log }).expect("cones");
    let p = |choice: &pigments::Choice| pigments::chart(choice).expect("pigments");
    let usual = pigments::Choice::default;
    vec![
        ("v-lambda", v(&v_lambda::Choice::default())),
        ("v-lambda absolute", v(&v_lambda::Choice { absolute: true, ..v_lambda::Choice::default() })),
        ("v-lambda all log", v(&v_lambda::Choice { functions, mesopic: vec![], absolute: false, log: true })),
        ("cones", c(vec![Cones::StockmanSharpe2, Cones::StockmanSharpe10], false, false)),
        ("cones by age", c(vec![individual(20.0, 2.0), individual(60.0, 2.0), individual(80.0, 2.0)], false, false)),
        ("cones by field", c(vec![individual(32.0, 2.0), individual(32.0, 10.0)], true, true)),
        ("pigments", p(&usual())),
        ("pigments and media", p(&pigments::Choice { media: true, ..usual() })),
        ("pigments log", p(&pigments::Choice { quantity: pigments::Quantity::Absorbance, log: true, ..usual() })),
        ("cmf", cmf::chart(&[Matching::Cie1931]).expect("cmf")),
        ("cmf of three", cmf::chart(&[Matching::Cie1931, Matching::Cie1964, Matching::Cie2015TwoDegree]).expect("cmf")),
        ("rgb", cmf::chart(&[Matching::WrightGuild1931]).expect("rgb")),
        ("spectrum", spectra(&["D65"], spectrum::Scaling::Peak)),
        ("spectra", spectra(&["D65", "A", "FL11", "LED-B3"], spectrum::Scaling::At560Nm)),
        ("lines", mercury()),
        ("reflectance", patches("ColorChecker")),
        ("blackbody", blackbody::chart(&blackbody::TEMPERATURES_K, blackbody::Quantity::Radiance).expect("bodies")),
        ("blackbody far", blackbody::chart(&[1.0, 1e3, 1e7], blackbody::Quantity::Exitance).expect("bodies")),
    ]
}

const SIZES: [Size; 4] = [Size::Paper, Size::Column, Size::Slide, Size::Custom { width_px: 1000, height_px: 800 }];

/// Every chart in both themes and all sizes: what it is called, the chart, its picture.
fn all_drawn() -> Vec<(String, Chart, String)> {
    let mut drawn = Vec::new();
    for size in SIZES {
        // A chromaticity diagram is made for a size.
        let diagrams = [("xy", Diagram::Xy), ("u′v′", Diagram::UvPrime)].map(|(name, diagram)| {
            let contents = Contents { size, ..Contents::new(diagram, Matching::Cie1931) };
            (name, chromaticity::chart(&contents).expect("a diagram"))
        });
        for (name, chart) in charts().into_iter().chain(diagrams) {
            for theme in [Theme::Light, Theme::Dark] {
                let svg = plot::svg(&chart, &style(theme, size)).unwrap_or_else(|e| panic!("{name} {size:?}: {e}"));
                drawn.push((format!("{name}, {theme:?}, {size:?}"), chart.clone(), svg));
            }
        }
    }
    drawn
}

fn attribute(node: &Node, name: &str) -> f64 {
    node.attribute(name).and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("`{name}` of {node:?}"))
}

/// Text as it is read, subscripts included.
fn text_of(node: &Node) -> String {
    node.descendants().filter(Node::is_text).filter_map(|part| part.text()).collect()
}

/// A text of a chart as it is read.
fn read(text: &str) -> String {
    text.replace("_{", "").replace('}', "")
}

fn texts(document: &Document) -> Vec<String> {
    document.descendants().filter(|node| node.has_tag_name("text")).map(|node| text_of(&node)).collect()
}

#[test]
fn every_plot_is_well_formed_and_says_what_it_shows() {
    for (name, chart, svg) in all_drawn() {
        let document = Document::parse(&svg).unwrap_or_else(|e| panic!("{name}: {e}"));
        let texts = texts(&document);
        let all = texts.join(" ");
        for axis in [&chart.x, &chart.y].into_iter().chain(&chart.impulse_axis) {
            assert!(texts.contains(&read(&axis.name())), "{name}: no `{}`", axis.name());
            assert!(!axis.unit.is_empty(), "{name}: `{}` has no unit", axis.name());
        }
        for curve in &chart.curves {
            assert!(all.contains(&read(curve.text())), "{name}: no `{}`", curve.text());
        }
        for key in &chart.keys {
            assert!(texts.contains(&key.text), "{name}: no `{}`", key.text);
        }
        assert!(all.replace(' ', "").contains(&read(&chart.title).replace(' ', "")), "{name}: no title");
        let root = document.root_element();
        assert!(
            root.attribute("font-family").is_some_and(|family| family.starts_with("Roboto, ") && family.ends_with("sans-serif")),
            "{name}"
        );
        assert!(svg.len() < 200_000, "{name}: {} bytes", svg.len());
        let ids: Vec<&str> = document.descendants().filter_map(|node| node.attribute("id")).collect();
        for reference in svg.split("url(#").skip(1).filter_map(|rest| rest.split(')').next()) {
            assert!(ids.contains(&reference), "{name}: `{reference}` is not there");
        }
    }
}

/// Boxes of all texts in px of the picture, from the layout of the font.
fn boxes(svg: &str) -> Vec<(String, [f64; 4])> {
    let mut fonts = resvg::usvg::fontdb::Database::new();
    for font in ["Regular", "Medium"] {
        let path = format!("{}/assets/Roboto-{font}.ttf", env!("CARGO_MANIFEST_DIR"));
        fonts.load_font_data(std::fs::read(path).expect("the font"));
    }
    let options = resvg::usvg::Options { fontdb: fonts.into(), ..Default::default() };
    let tree = resvg::usvg::Tree::from_str(svg, &options).expect("SVG");
    fn collect(group: &resvg::usvg::Group, found: &mut Vec<(String, [f64; 4])>) {
        for node in group.children() {
            match node {
                resvg::usvg::Node::Group(inner) => collect(inner, found),
                resvg::usvg::Node::Text(text) => {
                    let area = text.abs_bounding_box();
                    let words = text.chunks().iter().map(|chunk| chunk.text()).collect::<String>();
                    // Line height holds more than the letters: capitals and descenders take 0.94 of 1.17.
                    let (top, height) = (f64::from(area.top()), f64::from(area.height()));
                    let box_px = [f64::from(area.left()), top + 0.17 * height, f64::from(area.right()), top + 0.97 * height];
                    found.push((words, box_px));
                }
                _ => {}
            }
        }
    }
    let mut found = Vec::new();
    collect(tree.root(), &mut found);
    found
}

/// Two texts of which one stands on the other.
fn overlap(boxes: &[(String, [f64; 4])]) -> Option<String> {
    for (index, (text, area)) in boxes.iter().enumerate() {
        for (other, taken) in &boxes[index + 1..] {
            if area[2] > taken[0] && taken[2] > area[0] && area[3] > taken[1] && taken[3] > area[1] {
                return Some(format!("`{text}` {area:?} and `{other}` {taken:?}"));
            }
        }
    }
    None
}

#[test]
fn texts_on_top_of_each_other_would_be_found() {
    let two = |gap: f64| {
        let texts = [0.0, gap].map(|x| format!("<text x=\"{}\" y=\"50\" font-size=\"10\">wavelength</text>", 20.0 + x));
        let svg =
            format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 200 100\" font-family=\"Roboto\">{}</svg>", texts.concat());
        overlap(&boxes(&svg))
    };
    assert!(two(40.0).is_some() && two(60.0).is_none());
}

#[test]
fn no_text_stands_on_another_and_nothing_leaves_the_canvas() {
    for (name, _, svg) in all_drawn() {
        let document = Document::parse(&svg).expect("SVG");
        let view: Vec<f64> =
            document.root_element().attribute("viewBox").expect("a view").split(' ').map(|n| n.parse().expect("a number")).collect();
        let (width, height) = (view[2], view[3]);
        // The document is scaled to its size in mm; boxes come in px of that size.
        let boxes = boxes(&svg);
        assert!(boxes.len() > 8, "{name}");
        for (text, area) in &boxes {
            let inside = area[0] >= 0.0 && area[1] >= 0.0 && area[2] <= width + 0.5 && area[3] <= height + 0.5;
            assert!(inside, "{name}: `{text}` at {area:?} leaves {width} × {height}");
        }
        assert_eq!(overlap(&boxes), None, "{name}");
        for [x, y] in shapes(&document).into_iter().flat_map(|(_, points)| points) {
            let inside = (0.0..=width + 0.1).contains(&x) && (0.0..=height + 0.1).contains(&y);
            assert!(inside, "{name}: ({x}, {y}) leaves {width} × {height}");
        }
    }
}

/// Strokes and areas: colour and corners in px of the picture.
fn shapes(document: &Document) -> Vec<(String, Vec<[f64; 2]>)> {
    let drawn = document.descendants().filter(|node| node.has_tag_name("polyline") || node.has_tag_name("polygon"));
    drawn
        .map(|node| {
            let colour = node.attribute("stroke").or(node.attribute("fill")).unwrap_or_default().to_owned();
            let pairs = node.attribute("points").unwrap_or_default().split_whitespace();
            let points = pairs.map(|pair| {
                let (x, y) = pair.split_once(',').expect("x,y");
                [x, y].map(|n| n.parse::<f64>().expect("a number") / 16.0)
            });
            (colour, points.collect())
        })
        .collect()
}

/// What px are on an axis, from the ticks as they are labelled.
fn axis_of(document: &Document, axis: &Axis, at: fn(&Node) -> Option<f64>) -> impl Fn(f64) -> f64 + use<> {
    let ticks: Vec<(f64, f64)> = document
        .descendants()
        .filter(|node| node.has_tag_name("text"))
        .filter_map(|node| Some((text_of(&node).replace('−', "-").parse().ok()?, at(&node)?)))
        .collect();
    assert!(ticks.len() >= 2, "ticks of `{}`", axis.quantity);
    let (first, last) = (ticks[0], ticks[ticks.len() - 1]);
    assert_eq!(axis.scale, Scale::Linear);
    move |px| first.0 + (px - first.1) / (last.1 - first.1) * (last.0 - first.0)
}

#[test]
fn the_peak_of_the_line_stands_at_the_wavelength_of_the_peak() {
    let peaks = [(Efficiency::Photopic1924, 555.0), (Efficiency::Scotopic1951, 507.0)];
    for (function, peak_nm) in peaks {
        let choice = v_lambda::Choice { functions: vec![function], mesopic: vec![], absolute: true, log: false };
        let chart = v_lambda::chart(&choice).expect("V");
        let svg = plot::svg(&chart, &style(Theme::Light, Size::Slide)).expect("drawable");
        let document = Document::parse(&svg).expect("SVG");
        let middle = |node: &Node| (node.attribute("text-anchor") == Some("middle")).then(|| attribute(node, "x"));
        // The tick's number is centred on its line: half of the height of a capital below it.
        let line = |node: &Node| {
            (node.attribute("text-anchor") == Some("end")).then(|| attribute(node, "y") - 0.36 * attribute(node, "font-size"))
        };
        let (nm, value) = (axis_of(&document, &chart.x, middle), axis_of(&document, &chart.y, line));
        let curve = shapes(&document).into_iter().max_by_key(|(_, points)| points.len()).expect("a curve").1;
        let top = curve.iter().copied().min_by(|a, b| a[1].total_cmp(&b[1])).expect("points");
        assert!((nm(top[0]) - peak_nm).abs() < 1.1, "{function:?}: {}", nm(top[0]));
        assert!((value(top[1]) / function.max_efficacy_lm_w() - 1.0).abs() < 2e-3, "{function:?}: {}", value(top[1]));
    }
}

#[test]
fn the_table_holds_the_values_of_the_functions() {
    let rows = |chart: &Chart| -> BTreeMap<(String, String), f64> {
        plot::csv(chart)
            .lines()
            .skip(1)
            .map(|line| {
                let cells: Vec<&str> = line.split(',').collect();
                ((cells[0].to_owned(), cells[2].to_owned()), cells[3].parse().unwrap_or(f64::NAN))
            })
            .collect()
    };
    let found = rows(&cmf::chart(&[Matching::Cie1931]).expect("cmf"));
    for (function, name) in Matching::Cie1931.functions().iter().zip(Matching::Cie1931.names()) {
        for nm in (380..=780).step_by(7) {
            assert_eq!(found[&(name.to_owned(), nm.to_string())], function.at(f64::from(nm)), "{name} {nm} nm");
        }
    }
    let found = rows(&blackbody::chart(&[2856.0], blackbody::Quantity::Exitance).expect("a body"));
    for ((_, nm), value) in found {
        let exact = etendue::spectrum::black_body::spectral_exitance(nm.parse().expect("a wavelength"), 2856.0);
        assert!((value / exact - 1.0).abs() < 1e-11, "{nm} nm: {value} {exact}");
    }
    let found = plot::csv(&mercury());
    assert!(found.starts_with("item,kind,Wavelength λ (nm),Power of a line (W),"), "{found}");
    assert!(found.contains("546.07 nm,line,546.07,3"), "{found}");
}

#[test]
fn the_same_chart_gives_the_same_picture() {
    for (_, chart) in charts().into_iter().take(3) {
        let drawn = || plot::svg(&chart, &style(Theme::Light, Size::Paper)).expect("drawable");
        assert_eq!(drawn(), drawn());
    }
}

#[test]
fn a_png_has_the_size_that_was_asked_for() {
    let chart = cmf::chart(&[Matching::Cie1931]).expect("cmf");
    let svg = plot::svg(&chart, &style(Theme::Dark, Size::Slide)).expect("drawable");
    let png = plot::png(&svg, 1.5).expect("PNG");
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    let side = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().expect("four bytes"));
    assert_eq!((side(16), side(20)), (1920, 1080));
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e4] {
        assert!(plot::png(&svg, scale).is_err(), "{scale}");
    }
}

#[test]
fn hostile_charts_are_errors_or_pictures_and_never_broken() {
    let axis = |from, to| Axis::linear("<x> & \"y\"", "nm", from, to);
    let good = || axis(0.0, 1.0);
    for (from, to) in [(0.0, 0.0), (1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::INFINITY), (-f64::MAX, f64::MAX), (1.0, 1.0 + 1e-15)] {
        let chart = Chart::new("t", "s", axis(from, to), good());
        assert!(matches!(plot::svg(&chart, &style(Theme::Light, Size::Paper)), Err(PlotError::Range { .. })), "{from} {to}");
    }
    assert!(plot::svg(&Chart::new("", "", Axis::log("", "", 0.0, 1.0), good()), &style(Theme::Light, Size::Paper)).is_err());
    let mut chart = Chart::new("<script>\u{1}&", "]]> \"quoted\" 'too'", good(), axis(-1e300, 1e300));
    let wild = [f64::NAN, f64::INFINITY, -f64::INFINITY, 1e308, -1e308, 0.5, 5e-324];
    let points = wild.iter().flat_map(|x| wild.iter().map(|y| [*x, *y])).collect();
    chart.curves.push(Curve::new("a <b> c", points, Ink::Palette(usize::MAX)));
    chart.points.push(Point { label: "&".to_owned(), written: true, at: [0.5, 0.0], ink: Ink::Muted, radius: 1.0 });
    let svg = plot::svg(&chart, &style(Theme::Dark, Size::Paper)).expect("drawable");
    let document = Document::parse(&svg).expect("well-formed");
    assert!(texts(&document).contains(&"<script>\u{fffd}&".to_owned()));
    let tiny = style(Theme::Light, Size::Custom { width_px: 1, height_px: 1 });
    let many = (0..200).map(|i| Curve::new(&format!("a curve with a long name {i}"), vec![[0.0, 0.0], [1.0, 1.0]], Ink::Text));
    chart.curves.extend(many);
    assert!(matches!(plot::svg(&chart, &tiny), Err(PlotError::TooSmall { .. })));
}

#[test]
fn what_cannot_be_drawn_says_what_can() {
    let message = |result: Result<Chart, PlotError>| result.expect_err("an error").to_string();
    let none = v_lambda::Choice { functions: vec![], mesopic: vec![], absolute: false, log: false };
    assert!(message(v_lambda::chart(&none)).contains("nothing to draw"));
    assert!(message(v_lambda::chart(&v_lambda::Choice { mesopic: vec![1.5], ..none })).contains('1'));
    let set = |cones| cones::Choice { sets: vec![cones], quantal: false, log: false };
    assert!(message(cones::chart(&set(individual(19.0, 2.0)))).contains("20"));
    assert!(message(cones::chart(&set(individual(20.0, f64::NAN)))).contains("10"));
    assert!(message(cones::chart(&cones::Choice { quantal: true, ..set(Cones::StockmanSharpe2) })).contains("age"));
    assert!(message(cmf::chart(&[Matching::Cie1931, Matching::WrightGuild1931])).contains("apart"));
    assert!(message(blackbody::chart(&[0.0], blackbody::Quantity::Radiance)).contains("1 K"));
    assert!(message(blackbody::chart(&[], blackbody::Quantity::Radiance)).contains("1 to 12"));
    let infrared = spectrum::Item { name: "IR".to_owned(), density: Density::line(1064.0, 1.0).expect("a line") };
    let choice =
        spectrum::Choice { items: vec![infrared], scaling: spectrum::Scaling::Peak, unit: String::new(), from_nm: 380.0, to_nm: 780.0 };
    assert!(message(spectrum::chart(&choice)).contains("`IR` is zero from 380 nm to 780 nm"));
    let ultraviolet = reflectance::Item { name: "UV".to_owned(), factor: Factor::Band { from_nm: 200.0, to_nm: 300.0, value: 1.0 } };
    assert!(reflectance::chart("t", &[ultraviolet]).is_ok(), "a band is zero where it is not one, and that is a value");
}

#[cfg(feature = "cli")]
fn etendue(folder: &std::path::Path, arguments: &[&str]) -> (Option<i32>, String) {
    let run = std::process::Command::new(env!("CARGO_BIN_EXE_etendue")).current_dir(folder).args(arguments).output().expect("it starts");
    (run.status.code(), String::from_utf8_lossy(&run.stderr).into_owned())
}

#[cfg(feature = "cli")]
#[test]
fn the_command_writes_whole_files_and_says_which() {
    let folder = std::env::temp_dir().join(format!("etendue-plots-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let names = || -> Vec<String> {
        let mut names: Vec<String> =
            std::fs::read_dir(&folder).expect("readable").flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    };
    let failing: [(&[&str], &[&str]); 11] = [
        (&["plot", "v-lambda", "--out", "plot.gif"], &[".gif", ".svg, .png", "plot.svg"]),
        (&["plot", "v-lambda", "skotopic"], &["skotopic", "V'(lambda)"]),
        (&["plot", "konus"], &["konus", "cones"]),
        (&["plot", "cones", "--age", "19,20"], &["19", "20 yr"]),
        (&["plot", "spectrum", "D56", "FL99"], &["D56", "D55", "FL99"]),
        (&["plot", "reflectance", "ColorChecker pink"], &["pink", "ColorChecker"]),
        (&["plot", "blackbody", "-3"], &["-3", "1 K"]),
        (&["plot", "cmf", "--out", "cmf.svg", "--csv", "cmf.svg"], &["cmf.svg", "a name of their own"]),
        (&[&["plot", "spectrum"][..], &["D65"; 25]].concat(), &["25", "at most 24"]),
        (&["plot", "cmf", "--size", "10x10"], &["10x10", "slide"]),
        (&["plot", "spectrum", "D65", "--range", "700,400"], &["700,400", "380,780"]),
    ];
    for (arguments, said) in failing {
        let (code, message) = etendue(&folder, arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {message}");
        assert!(said.iter().all(|part| message.contains(part)), "{arguments:?}: {message}");
    }
    assert!(names().is_empty(), "{:?}", names());
    let (code, message) = etendue(&folder, &["plot", "cones", "--age", "20,60", "--csv", "cones.csv"]);
    assert_eq!((code, message.as_str()), (Some(0), "wrote cones.svg\nwrote cones.csv\n"));
    assert_eq!(names(), ["cones.csv", "cones.svg"]);
    let (code, message) = etendue(&folder, &["plot", "cmf", "--out", "nowhere/x.png"]);
    assert_eq!(code, Some(2), "{message}");
    std::fs::remove_dir_all(&folder).expect("removable");
}
