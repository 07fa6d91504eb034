//! Ticks on the spectral locus and the wavelengths beside them: outwards along the normal, as many as there is room for.

use super::super::chart::{Anchor, Chart, Curve, Ink, Note};
use super::Diagram;
use super::loci::{DRAWN_NM, unit};
use crate::observer::colour::{Chromaticity, spectral_locus};
use crate::spectrum::Factor;

/// Lengths of ticks every 10 nm and every 5 nm, in sizes of the text.
const TICK_EM: [f64; 2] = [0.55, 0.3];
/// Size of the written wavelengths, in sizes of the text; half their box.
const TEXT: f64 = 0.94;
const HALF_BOX_EM: [f64; 2] = [0.87 * TEXT, 0.38 * TEXT];

/// A wavelength on the locus.
struct Place {
    nm: u32,
    at: [f64; 2],
    outwards: [f64; 2],
}

/// Locus, purple line, ticks and wavelengths. `em` is the size of the text in units of the plane.
pub(super) fn draw(chart: &mut Chart, diagram: Diagram, matching: &[Factor; 3], outline: Vec<[f64; 2]>, em: f64) {
    let thin = |label: &str, points, width| Curve { width, ..Curve::new(label, points, Ink::Text).unwritten() };
    if let (Some(first), Some(last)) = (outline.first(), outline.last()) {
        chart.curves.push(thin("Purple line", vec![*last, *first], 0.8));
    }
    let places = places(diagram, matching, em);
    let mut ticks = Vec::new();
    for place in &places {
        let length = TICK_EM[usize::from(place.nm % 10 != 0)] * em;
        let end = [place.at[0] + length * place.outwards[0], place.at[1] + length * place.outwards[1]];
        ticks.extend([place.at, end, [f64::NAN; 2]]);
    }
    chart.curves.push(thin("Wavelengths", ticks, 0.5));
    chart.curves.push(thin("Spectral locus", outline, 0.8));
    for (place, shift_em) in written(&places, diagram, em) {
        // A note's shift is in sizes of its own text.
        let shift_em = shift_em.map(|shift| shift / TEXT);
        chart.notes.push(Note { text: place.nm.to_string(), at: place.at, shift_em, anchor: Anchor::Middle, ink: Ink::Muted });
    }
}

/// Every 5 nm where the ticks leave room between them; rounder ones, which come first, displace the others.
fn places(diagram: Diagram, matching: &[Factor; 3], em: f64) -> Vec<Place> {
    let (from_nm, to_nm) = (DRAWN_NM.0 as u32, DRAWN_NM.1 as u32);
    let rank = |nm: u32| [100, 50, 20, 10, 5].iter().position(|step| nm.is_multiple_of(*step));
    let mut order: Vec<u32> = (from_nm..=to_nm).step_by(5).collect();
    order.sort_by_key(|nm| (rank(*nm), *nm));
    let at = |nm: u32| spectral_locus(matching, f64::from(nm), f64::from(nm), 1.0).first().map(|point| diagram.place(&point.chromaticity));
    let mut places: Vec<Place> = Vec::new();
    for nm in order {
        let (Some(here), Some(before), Some(after)) = (at(nm), at(nm.saturating_sub(2).max(from_nm)), at((nm + 2).min(to_nm))) else {
            continue;
        };
        let [dx, dy] = unit([after[0] - before[0], after[1] - before[1]]);
        let apart = places.iter().all(|other| (here[0] - other.at[0]).hypot(here[1] - other.at[1]) > 0.3 * em);
        if dx.is_finite() && dy.is_finite() && apart {
            // From blue over green to red the outside is at the left hand; at the red end some observers' locus folds back.
            let white = diagram.place(&Chromaticity { x: 1.0 / 3.0, y: 1.0 / 3.0 });
            let folded = -dy * (here[0] - white[0]) + dx * (here[1] - white[1]) < 0.0;
            places.push(Place { nm, at: here, outwards: if folded { [dy, -dx] } else { [-dy, dx] } });
        }
    }
    places
}

/// Which wavelengths are written, in the order of their ticks, and the shift of the middle of their text in sizes of the text.
fn written(places: &[Place], diagram: Diagram, em: f64) -> Vec<(&Place, [f64; 2])> {
    let [(left, right), (low, high)] = diagram.ranges();
    let half = HALF_BOX_EM.map(|h| h * em);
    let mut kept: Vec<(&Place, [f64; 2])> = Vec::new();
    for place in places.iter().filter(|place| place.nm % 10 == 0) {
        let [nx, ny] = place.outwards;
        let distance = TICK_EM[0] + 0.28 + nx.abs() * HALF_BOX_EM[0] + ny.abs() * HALF_BOX_EM[1];
        let shift = [nx * distance, ny * distance];
        let middle = |place: &Place, shift: &[f64; 2]| [place.at[0] + shift[0] * em, place.at[1] + shift[1] * em];
        let [x, y] = middle(place, &shift);
        let inside = x - half[0] > left && x + half[0] < right && y - half[1] > low && y + half[1] < high;
        let apart = kept.iter().all(|(other, other_shift)| {
            let [ox, oy] = middle(other, other_shift);
            (x - ox).abs() > 2.0 * half[0] + 0.35 * em || (y - oy).abs() > 2.0 * half[1] + 0.3 * em
        });
        if inside && apart {
            kept.push((place, shift));
        }
    }
    kept
}
