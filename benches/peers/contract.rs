//! The scenes of the peers lab (`scenes.json`, `SCENES.md`) in the words of this program: a scene file, a sensor file, curves, meshes.
//!
//! | there | here |
//! |---|---|
//! | quad `p`, `u`, `v` | `Quad(corner, u, v)`; reflects on both sides, emits from its front |
//! | sphere, `side` | `Sphere(radius)`, `seen_from: Inside` or `Outside` |
//! | mesh | `Mesh("….ply")`, the bytes from the lab's `cache/` |
//! | table | a curve file |
//! | grey radiance L | `Radiance(L)` of a single line under a responsivity of 1 |
//! | `radiance_spectrum`, `scale` | `Absolute(scale)` of the curve |
//! | `irradiance_point`, `_square`, `_grid` | `Point`, `Rectangle` aperture, `grid: (…)` |
//! | `responsivity`, `factor` | `Illuminance(efficacy_lm_w: factor)` |

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use etendue::scene::{MemoryFiles, Scene, read_scene};
use serde::Deserialize;

/// Anything that goes wrong, in words.
pub(crate) type Failure = Box<dyn std::error::Error>;

/// `scenes.json`.
#[derive(Deserialize)]
pub(crate) struct Contract {
    lambda_nm: Vec<f64>,
    spectra: BTreeMap<String, Vec<f64>>,
    scenes: BTreeMap<String, serde_json::Value>,
}

#[derive(Deserialize)]
struct Given {
    title: String,
    surfaces: Vec<Surface>,
    #[serde(default)]
    lights: Vec<Light>,
    environment: Option<Environment>,
    sensors: Vec<Sensor>,
}

#[derive(Deserialize)]
struct Surface {
    id: String,
    #[serde(flatten)]
    shape: Shape,
    reflectance: Curve,
    emit: Option<Emission>,
}

#[derive(Deserialize)]
#[serde(tag = "type", rename_all = "lowercase")]
enum Shape {
    Quad { p: [f64; 3], u: [f64; 3], v: [f64; 3] },
    Sphere { center: [f64; 3], radius: f64, side: String },
    Mesh { file: String },
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Curve {
    Constant(f64),
    Table(String),
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Emission {
    Grey { radiance: f64 },
    Spectral { radiance_spectrum: String, scale: f64 },
}

#[derive(Deserialize)]
#[serde(tag = "type", rename_all = "lowercase")]
enum Light {
    Point { id: String, pos: [f64; 3], intensity: f64 },
}

#[derive(Deserialize)]
struct Environment {
    radiance: f64,
}

#[derive(Deserialize)]
struct Sensor {
    id: String,
    #[serde(flatten)]
    place: Place,
    normal: [f64; 3],
    responsivity: Option<String>,
    #[serde(default = "one")]
    factor: f64,
}

#[derive(Deserialize)]
#[serde(tag = "type")]
enum Place {
    #[serde(rename = "irradiance_point")]
    Point { pos: [f64; 3] },
    #[serde(rename = "irradiance_square")]
    Square { pos: [f64; 3], side: f64 },
    #[serde(rename = "irradiance_grid")]
    Grid { origin: [f64; 3], dx: [f64; 3], dy: [f64; 3], nx: usize, ny: usize },
}

fn one() -> f64 {
    1.0
}

impl Contract {
    /// Reads `scenes.json` of a lab's folder.
    pub(crate) fn read(lab: &Path) -> Result<Contract, Failure> {
        let path = lab.join("scenes.json");
        let text = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        Ok(serde_json::from_str(&text)?)
    }

    /// One of its scenes, read by this program as if from files.
    pub(crate) fn scene(&self, name: &str, lab: &Path) -> Result<Scene, Failure> {
        let value = self.scenes.get(name).ok_or_else(|| format!("scenes.json has no scene {name}"))?;
        let given = Given::deserialize(value)?;
        let mut files = MemoryFiles::new();
        let text = self.text(&given, lab, &mut files)?;
        files.0.insert("scene.ron".into(), text.into_bytes());
        Ok(read_scene("scene.ron", &files, None)?)
    }

    /// The text of the scene file; what it mentions is added to the files.
    fn text(&self, given: &Given, lab: &Path, files: &mut MemoryFiles) -> Result<String, Failure> {
        let (mut surfaces, mut objects, mut sources, mut instruments) = (String::new(), String::new(), String::new(), String::new());
        for s in &given.surfaces {
            let id = &s.id;
            let reflectance = match &s.reflectance {
                Curve::Constant(x) => format!("{x:?}"),
                Curve::Table(name) => format!("{:?}", self.curve(name, files)?),
            };
            writeln!(surfaces, "{id:?}: Lambertian({reflectance}),")?;
            let shape = match &s.shape {
                Shape::Quad { p, u, v } => format!("Quad(corner: {}, u: {}, v: {})", vector(p), vector(u), vector(v)),
                Shape::Sphere { center, radius, side } => {
                    let seen_from = if side == "in" { "Inside" } else { "Outside" };
                    format!("Sphere({radius:?}), at: {}, seen_from: {seen_from}", vector(center))
                }
                Shape::Mesh { file } => {
                    let path = lab.join(file);
                    let bytes = std::fs::read(&path).map_err(|e| format!("{}: {e}; make it with gen_mesh.py", path.display()))?;
                    files.0.insert(file.clone(), bytes);
                    format!("Mesh({file:?})")
                }
            };
            match &s.emit {
                None => writeln!(objects, "(name: {id:?}, surface: {id:?}, shape: {shape}),")?,
                Some(Emission::Grey { radiance }) => writeln!(
                    sources,
                    "(name: {id:?}, surface: {id:?}, strength: Radiance({radiance:?}), spectrum: {GREY}, shape: {shape}),"
                )?,
                Some(Emission::Spectral { radiance_spectrum, scale }) => {
                    let spectrum = self.curve(radiance_spectrum, files)?;
                    writeln!(
                        sources,
                        "(name: {id:?}, surface: {id:?}, strength: Absolute({scale:?}), spectrum: {spectrum:?}, shape: {shape}),"
                    )?;
                }
            }
        }
        for Light::Point { id, pos, intensity } in &given.lights {
            writeln!(
                sources,
                "(name: {id:?}, shape: Point, at: {}, strength: WattsPerSteradian({intensity:?}), spectrum: {GREY}),",
                vector(pos)
            )?;
        }
        if let Some(Environment { radiance }) = given.environment {
            writeln!(sources, "(name: \"environment\", shape: Environment, strength: Radiance({radiance:?}), spectrum: {GREY}),")?;
        }
        for s in &given.sensors {
            let channel = match &s.responsivity {
                None => "(name: \"E\", responsivity: 1.0, reads: Irradiance)".to_owned(),
                Some(name) => format!(
                    "(name: \"E\", responsivity: {:?}, reads: Illuminance(efficacy_lm_w: {:?}))",
                    self.curve(name, files)?,
                    s.factor
                ),
            };
            let (aperture, place) = match &s.place {
                Place::Point { pos } => ("Point".to_owned(), format!("at: {}", vector(pos))),
                Place::Square { pos, side } => {
                    (format!("Rectangle(width_m: {side:?}, height_m: {side:?})"), format!("at: {}", vector(pos)))
                }
                Place::Grid { origin, dx, dy, nx, ny } => {
                    let last: [f64; 3] = std::array::from_fn(|i| origin[i] + dx[i] * (*nx as f64 - 1.0) + dy[i] * (*ny as f64 - 1.0));
                    ("Point".to_owned(), format!("grid: (from: {}, to: {}, points: ({nx}, {ny}))", vector(origin), vector(&last)))
                }
            };
            writeln!(
                instruments,
                "(name: {:?}, sensor: Sensor(aperture: {aperture}, acceptance: Cosine, channels: [{channel}]), {place}, facing: {}),",
                s.id,
                vector(&s.normal)
            )?;
        }
        Ok(format!(
            "Scene(title: {:?},\nsurfaces: {{\n{surfaces}}},\nobjects: [\n{objects}],\nsources: [\n{sources}],\ninstruments: [\n{instruments}])\n",
            given.title
        ))
    }

    /// The name of a curve file with a table of the contract, which is added to the files.
    fn curve(&self, name: &str, files: &mut MemoryFiles) -> Result<String, Failure> {
        let values = self.spectra.get(name).ok_or_else(|| format!("scenes.json has no table {name}"))?;
        let mut text = format!("wavelength_nm,{name}\n");
        for (nm, value) in self.lambda_nm.iter().zip(values) {
            writeln!(text, "{nm:?},{value:?}")?;
        }
        let file = format!("{name}.csv");
        files.0.insert(file.clone(), text.into_bytes());
        Ok(file)
    }
}

/// All wavelengths are alike in a grey scene; one is enough.
const GREY: &str = "Line(555)";

fn vector(v: &[f64; 3]) -> String {
    format!("({:?}, {:?}, {:?})", v[0], v[1], v[2])
}
