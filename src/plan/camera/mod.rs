//! How a camera is rendered: rays through the pupil find what is seen, and for each source it is decided how its light gets there.
//!
//! ```text
//! L(ray) = L_emitted + (ρ/π) E_first + further reflections        or the radiance of the environment where nothing is met
//! ```
//!
//! | light of a source | how |
//! |---|---|
//! | seen itself | its radiance where a ray meets it; a source without extent is imaged through the pupil |
//! | after one reflection | `E_first` by its formula where nothing can stand between it and any surface that reflects (`surface_sees_source`), else connections |
//! | after more | paths, unless no surface that reflects sees another one (`surfaces_unseen`) |
//!
//! Per camera these are as many terms as sources times three, and each of them is kept or left out with its reason.

mod exchange;
mod explain;

use crate::observer::Efficiency;
use crate::plan::PlanOptions;
use crate::plan::spectral::{SpectralPlan, wavelengths_of};
use crate::quantity::constants::K_M_LM_W;
use crate::scene::{PlacedCamera, Scene};
use crate::spectrum::Factor;

/// The rules for cameras, with what they observe.
pub const RULES: [(&str, &str); 2] = [
    ("surface_sees_source", "nothing can stand between the source and any surface that reflects"),
    ("surfaces_unseen", "no surface that reflects sees another one"),
];

/// How the light of a source is computed at the surfaces that a camera sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FirstReflection {
    /// By the formula of its irradiance, where a ray from the pupil meets a surface.
    Formula,
    /// By connections with shadow rays, or, of an environment, by directions.
    Sampled,
    /// Not at all: no channel of the camera has a wavelength in common with it, or no surface reflects.
    Nothing,
}

/// How a camera is rendered.
#[derive(Clone, Debug)]
pub struct CameraPlan {
    /// Responsivities of the channels, electrons per joule at the pupil, and last that of luminance, lm/W.
    pub responsivities: Vec<Factor>,
    /// Per source: the first reflection of its light.
    pub first: Vec<FirstReflection>,
    /// Whether light is followed beyond the first reflection.
    pub interreflection: bool,
    /// The wavelengths of reflected light: the groups of sources, and the nodes that paths carry. `None` where nothing reflects.
    pub spectral: Option<SpectralPlan>,
}

impl CameraPlan {
    /// Plans every camera of a scene.
    pub(super) fn of(scene: &Scene, options: &PlanOptions) -> Vec<CameraPlan> {
        if scene.cameras.is_empty() {
            return Vec::new();
        }
        let on = |k: usize| !options.naive && !options.without.iter().any(|name| name == RULES[k].0);
        let reflecting = exchange::reflecting_sides(scene);
        let interreflection = !(reflecting.is_empty() || on(1) && exchange::no_exchange(scene, &reflecting));
        let clear: Vec<bool> = scene.sources.iter().map(|s| on(0) && exchange::clear(scene, &reflecting, s)).collect();
        scene
            .cameras
            .iter()
            .map(|placed| plan_camera(scene, placed, &clear, interreflection, reflecting.is_empty(), options.naive))
            .collect()
    }

    /// Whether reflected light needs paths or connections.
    #[must_use]
    pub fn needs_paths(&self) -> bool {
        self.spectral.is_some() && (self.interreflection || self.first.contains(&FirstReflection::Sampled))
    }
}

fn plan_camera(scene: &Scene, placed: &PlacedCamera, clear: &[bool], interreflection: bool, all_black: bool, naive: bool) -> CameraPlan {
    let camera = &placed.camera;
    let mut responsivities: Vec<Factor> = (0..camera.channels.len()).map(|c| camera.responsivity(c)).collect();
    responsivities.push(Efficiency::Photopic1924.curve().scaled(K_M_LM_W));
    let seen = |s: usize, c: usize| !scene.sources[s].density.joint_support(&[&responsivities[c]]).is_empty();
    let mut kept = Vec::new();
    let first: Vec<FirstReflection> = (0..scene.sources.len())
        .map(|s| {
            let channels: Vec<usize> = (0..responsivities.len()).filter(|&c| naive || seen(s, c)).collect();
            if all_black || channels.is_empty() {
                return FirstReflection::Nothing;
            }
            kept.extend(channels.into_iter().map(|c| (c, s)));
            if clear[s] { FirstReflection::Formula } else { FirstReflection::Sampled }
        })
        .collect();
    let spectral = (!kept.is_empty()).then(|| {
        let factors: Vec<&Factor> = responsivities.iter().collect();
        wavelengths_of(scene, &factors, &kept, naive)
    });
    CameraPlan { responsivities, first, interreflection: interreflection && spectral.is_some(), spectral }
}
