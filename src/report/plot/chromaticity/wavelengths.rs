//! Ticks on the spectral locus and the wavelengths beside them: outwards along the normal, as many as there is room for.

use super::super::chart::{Anchor, Chart, Curve, Ink, Note};
use super::loci::unit;
use super::{Diagram, unnamed};
use crate::observer::colour::{LOCUS_RANGE_NM, spectral_locus};
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
    if let (Some(first), Some(last)) = (outline.first(), outline.last()) {
        chart.curves.push(unnamed(vec![*last, *first], Ink::Text, 0.8));
    }
    let places = places(diagram, matching);
    let mut ticks = Vec::new();
    for place in &places {
        let length = TICK_EM[usize::from(place.nm % 10 != 0)] * em;
        let end = [place.at[0] + length * place.outwards[0], place.at[1] + length * place.outwards[1]];
        ticks.extend([place.at, end, [f64::NAN; 2]]);
    }
    chart.curves.push(unnamed(ticks, Ink::Text, 0.5));
    let mut locus = Curve::new("Spectral locus", outline, Ink::Text);
    locus.width = 0.8;
    chart.curves.push(locus);
    for (place, shift_em) in written(&places, diagram, em) {
        // A note's shift is in sizes of its own text.
        let shift_em = shift_em.map(|shift| shift / TEXT);
        chart.notes.push(Note { text: place.nm.to_string(), at: place.at, shift_em, anchor: Anchor::Middle, ink: Ink::Muted });
    }
}

/// Every 5 nm, where the locus moves on.
fn places(diagram: Diagram, matching: &[Factor; 3]) -> Vec<Place> {
    let (from_nm, to_nm) = LOCUS_RANGE_NM;
    let mut places: Vec<Place> = Vec::new();
    let at = |nm: f64| spectral_locus(matching, nm, nm, 1.0).first().map(|point| diagram.place(&point.chromaticity));
    for nm in (from_nm as u32..=to_nm as u32).step_by(5) {
        let middle = f64::from(nm);
        let (Some(here), Some(before), Some(after)) = (at(middle), at((middle - 2.0).max(from_nm)), at((middle + 2.0).min(to_nm))) else {
            continue;
        };
        let [dx, dy] = unit([after[0] - before[0], after[1] - before[1]]);
        // Near its ends the locus hardly moves: ticks there would stand on top of each other.
        let crowded = places.last().is_some_and(|last| (here[0] - last.at[0]).hypot(here[1] - last.at[1]) < 0.004);
        if dx.is_finite() && dy.is_finite() && (!crowded || nm % 100 == 0) {
            // From blue over green to red the outside is at the left hand.
            places.push(Place { nm, at: here, outwards: [-dy, dx] });
        }
    }
    places
}

/// Which wavelengths are written, rounder ones first, and the shift of the middle of their text in sizes of the text.
fn written(places: &[Place], diagram: Diagram, em: f64) -> Vec<(&Place, [f64; 2])> {
    let rank = |nm: u32| [100, 50, 20, 10].iter().position(|step| nm % step == 0);
    let mut order: Vec<(usize, &Place)> = places.iter().filter_map(|place| Some((rank(place.nm)?, place))).collect();
    order.sort_by_key(|(rank, place)| (*rank, place.nm));
    let [(left, right), (low, high)] = diagram.ranges();
    let half = HALF_BOX_EM.map(|h| h * em);
    let mut kept: Vec<(&Place, [f64; 2])> = Vec::new();
    for (_, place) in order {
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
