//! Scene files → scenes, or every problem of the scene and of the files that it mentions.

use std::collections::BTreeMap;

use super::Scene;
use super::camera_reader::read_camera;
use super::checks;
use super::decode::Value;
use super::diagnostic::{Diagnostic, Diagnostics};
use super::document::{Body, Document, Kind};
use super::files::{Files, MemoryFiles, normalised, root_of, within};
use super::instrument_reader::{MOST_POSES, read_instrument};
use super::object_reader::read_object;
use super::reading::Reading;
use super::source_reader::read_source;
use super::surface_reader::Surfaces;

const KEYS: [&str; 6] = ["title", "surfaces", "objects", "sources", "instruments", "cameras"];

/// Reads a scene and all files that it mentions.
///
/// `path` is what `files` is asked for; `root` is the folder that no name may leave, by default the one that holds the
/// scene's `scenes` folder, else the scene's own folder (see [`super::files`]).
///
/// # Errors
/// Every problem of every file, at least one. A break of syntax ends the reading of its file.
pub fn read_scene(path: &str, files: &dyn Files, root: Option<&str>) -> Result<Scene, Diagnostics> {
    let path = normalised(path);
    let root = root.map_or_else(|| root_of(&path), normalised);
    if !within(&path, &root) {
        let help = "give the scene and the root both as relative or both as absolute paths, the scene inside the root".to_string();
        return Err(Diagnostics(vec![Diagnostic::of_file(&path, format!("the scene lies outside of the root `{root}`"), Some(help))]));
    }
    let mut reading = Reading::new(files, &path, root);
    let document = reading.first_document(&path, "scene");
    let scene = document.and_then(|document| read_scene_document(&document, &mut reading));
    match scene {
        Some(scene) if reading.problems.count() == 0 => Ok(scene),
        _ => Err(reading.problems.finish()),
    }
}

/// Reads a scene that mentions no other files.
///
/// # Errors
/// As [`read_scene`].
pub fn scene_from_text(text: &str) -> Result<Scene, Diagnostics> {
    read_scene("scene.ron", &MemoryFiles::new().with("scene.ron", text), None)
}

/// Where the parts of a scene stand in its file, for checks of the whole scene.
#[derive(Debug, Default)]
pub(super) struct Places<'d> {
    /// One for each source.
    pub(super) sources: Vec<Value<'d>>,
    /// One for each instrument.
    pub(super) instruments: Vec<Value<'d>>,
}

/// The scene that a document holds, checked.
pub(super) fn read_scene_document(document: &Document, reading: &mut Reading) -> Option<Scene> {
    let root = Value::root(document);
    if root.name() != "Scene" {
        let found = root.described();
        root.problem_at(
            &root.name_span(),
            &mut reading.problems,
            format!("a scene file holds `Scene(…)`, not {found}"),
            "write `Scene(sources: […], instruments: […])`",
        );
        return None;
    }
    let fields = root.fields("`Scene`", &KEYS, &mut reading.problems)?;
    let file = document.file.rsplit('/').next().unwrap_or_default();
    let title = fields.get("title").map_or(Some(file), |title| title.text(&mut reading.problems));
    let surfaces = Surfaces::read(fields.get("surfaces").as_ref(), reading);
    let items = |key: &str, reading: &mut Reading| {
        fields.get(key).and_then(|v| v.list(&format!("`{key}`"), &mut reading.problems)).unwrap_or_default()
    };
    let (objects, sources, instruments) = (items("objects", reading), items("sources", reading), items("instruments", reading));

    let mut scene = Scene { title: title.unwrap_or_default().into(), ..Scene::default() };
    let mut places = Places::default();
    let mut names = Names::default();
    for item in objects {
        let name = names.take(&item, "object", reading);
        scene.elements.extend(read_object(&item, name, &surfaces, reading).unwrap_or_default());
    }
    for item in sources {
        let name = names.take(&item, "source", reading);
        let mut elements = std::mem::take(&mut scene.elements);
        if let Some(source) = read_source(&item, name, &surfaces, &mut elements, reading) {
            scene.sources.push(source);
            places.sources.push(item);
        }
        scene.elements = elements;
    }
    let mut names = Names::default();
    let mut poses_left = MOST_POSES;
    let cameras = items("cameras", reading);
    let none = instruments.is_empty() && cameras.is_empty();
    for item in instruments {
        let name = names.take(&item, "instrument", reading);
        if let Some(instrument) = read_instrument(&item, name, &mut poses_left, reading) {
            scene.instruments.push(instrument);
            places.instruments.push(item);
        }
    }
    for item in cameras {
        let name = names.take(&item, "camera", reading);
        scene.cameras.extend(read_camera(&item, name, reading));
    }
    if none {
        let example =
            "instruments: [(name: \"meter\", sensor: \"../sensors/ideal-illuminance-meter.ron\", at: (0, 0, 0), facing: (0, 0, 1))]";
        match fields.get("instruments") {
            None => drop(fields.require("instruments", example.trim_start_matches("instruments: "), &mut reading.problems)),
            Some(value) if matches!(value.node.kind, Kind::List(_)) => {
                value.problem(
                    &mut reading.problems,
                    "the scene has no instrument, so there is nothing to read",
                    format!("write `{example}`"),
                );
            }
            Some(_) => {}
        }
    }
    scene.surfaces = surfaces.list;
    scene.hash = reading.hash;
    scene.remarks = std::mem::take(&mut reading.remarks);
    checks::run(&scene, &places, &mut reading.problems);
    Some(scene)
}

/// Names that have been given, with what they were given to.
#[derive(Default)]
struct Names(BTreeMap<String, (&'static str, std::ops::Range<usize>)>);

impl Names {
    /// The name of an object, source or instrument, which must be new.
    fn take<'d>(&mut self, item: &Value<'d>, what: &'static str, reading: &mut Reading) -> Option<&'d str> {
        let Kind::Struct { body: Body::Named(fields), .. } = &item.node.kind else { return Some("") };
        let Some(field) = fields.iter().find(|field| field.name == "name") else {
            let span = item.node.span.start..item.node.span.start + 1;
            let article = if matches!(what, "source" | "camera") { "a" } else { "an" };
            item.problem_at(&span, &mut reading.problems, format!("{article} {what} has no `name`"), "add `name: \"…\"`");
            return None;
        };
        let value = item.child(&field.value, "name");
        let name = value.text(&mut reading.problems)?;
        if name.trim().is_empty() {
            value.problem(&mut reading.problems, "the name is empty", "write a name to be found again in reports");
            return None;
        }
        if let Some((earlier, span)) = self.0.get(name).filter(|_| !reading.problems.is_full()) {
            let line = item.document.place(span).line;
            let both = if *earlier == what {
                format!("two {what}s are called \"{name}\"")
            } else {
                format!("an {earlier} and a {what} are both called \"{name}\"")
            };
            value.problem(&mut reading.problems, both, format!("the first is in line {line}; give each its own name"));
        }
        self.0.entry(name.into()).or_insert((what, field.value.span.clone()));
        Some(name)
    }
}
