//! `surfaces: { "white paint": Lambertian(0.85), "oak": Lambertian("oak.csv"), "velvet": Black }`

use std::collections::BTreeMap;

use super::decode::Value;
use super::document::Kind;
use super::factor_range::outside_of;
use super::reading::Reading;
use super::spectrum_reader::read_factor;
use crate::naming::nearest;
use crate::spectrum::{Factor, Outside};
use crate::surface::Surface;

/// The surfaces of a scene by name. The first is always black.
#[derive(Debug)]
pub(super) struct Surfaces {
    pub(super) list: Vec<Surface>,
    /// Index into the list; none for a surface with problems.
    by_name: BTreeMap<String, Option<usize>>,
}

/// Index of the surface that absorbs everything.
pub(super) const BLACK: usize = 0;

impl Surfaces {
    /// Reads the map of surfaces.
    pub(super) fn read(value: Option<&Value>, reading: &mut Reading) -> Self {
        let mut surfaces = Self { list: vec![Surface::black()], by_name: BTreeMap::new() };
        let Some(value) = value else { return surfaces };
        let Kind::Map(entries) = &value.node.kind else {
            let found = value.described();
            value.problem(
                &mut reading.problems,
                format!("surfaces are written as a map, not {found}"),
                "write `{ \"white paint\": Lambertian(0.85) }`",
            );
            return surfaces;
        };
        for (key, node) in entries {
            let Some(name) = value.child(key, "key").text(&mut reading.problems) else { continue };
            let item = value.child(node, &format!("[\"{name}\"]"));
            if surfaces.by_name.contains_key(name) {
                item.problem_at(&key.span, &mut reading.problems, format!("two surfaces are called \"{name}\""), "give each its own name");
            }
            let index = read_surface(name, &item, reading).map(|surface| {
                surfaces.list.push(surface);
                surfaces.list.len() - 1
            });
            surfaces.by_name.insert(name.into(), index);
        }
        surfaces
    }

    /// The index of the surface that a value names.
    pub(super) fn find(&self, value: &Value, reading: &mut Reading) -> Option<usize> {
        if value.name() == "Black" {
            return Some(BLACK);
        }
        let name = value.text(&mut reading.problems)?;
        if let Some(index) = self.by_name.get(name) {
            return *index;
        }
        // A hostile file may name very many.
        let names: Vec<&str> = self.by_name.keys().take(if reading.problems.is_full() { 0 } else { 1000 }).map(String::as_str).collect();
        let help = match nearest(name, names.iter().copied()) {
            Some(near) => format!("did you mean \"{near}\"?"),
            None if names.is_empty() => "the scene has no `surfaces: { … }` yet".into(),
            None => format!("surfaces of this scene: {}", names.iter().take(20).map(|n| format!("\"{n}\"")).collect::<Vec<_>>().join(", ")),
        };
        value.problem(&mut reading.problems, format!("there is no surface called \"{name}\""), help);
        None
    }
}

fn read_surface(name: &str, value: &Value, reading: &mut Reading) -> Option<Surface> {
    match value.variant("a surface", &["Lambertian", "Black"], &mut reading.problems)? {
        "Black" => {
            value.without_brackets(&mut reading.problems)?;
            Some(Surface { name: name.into(), reflectance: Factor::Constant(0.0) })
        }
        _ => {
            let item = value.positional(1, "Lambertian(0.85)", &mut reading.problems)?.into_iter().next()?;
            let reflectance = read_factor(&item, Outside::Hold, reading)?;
            if let Some((nm, found)) = outside_of(&reflectance, 0.0, 1.0) {
                let constant = matches!(reflectance, Factor::Constant(_));
                let place = if constant { String::new() } else { format!(" at {nm} nm") };
                let excess = if found > 1.0 { ", more than all light" } else { "" };
                let help = "allowed: 0 to 1 at every wavelength (85 % is written 0.85)";
                item.problem(&mut reading.problems, format!("the reflectance is {found}{place}{excess}"), help);
                return None;
            }
            Some(Surface { name: name.into(), reflectance })
        }
    }
}
