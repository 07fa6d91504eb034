//! Indices of the spectral responsivity, by both routes.
//!
//! | index | computed | measured |
//! |---|---|---|
//! | f1′ | exact integrals of the curve | the same on the straight lines through the readings of the monochromator |
//! | u, r | exact integrals | a lamp with and without filter, sensor and ideal meter |
//! | λ̄ | exact integrals | straight lines through the readings |
//! | F of a lamp | exact integrals | sensor and ideal meter in turn before the lamp |

use super::{Absent, ChannelSheet, Index, Lamp, Responsivity, SheetError, Target, readout};
use crate::characterization::Figure;
use crate::characterization::bench::Bench;
use crate::characterization::bench::monochromator::Spectrogram;
use crate::characterization::bench::sampling::Sampled;
use crate::characterization::class_limits::{Limits, limits};
use crate::characterization::out_of_band::{Arrangement, response, share_behind};
use crate::characterization::spectral_mismatch::{MismatchError, Wavelengths, correction_factor, mean_wavelength_nm, mismatch_index};
use crate::quantity::Measurand;
use crate::sensor::{Channel, ResponsivityUncertainty, Sensor};
use crate::spectrum::{Density, Factor, library};

/// Lamps of the table of mismatch factors, by their names in the library.
pub const LAMPS: [&str; 24] = [
    "A", "D65", "FL1", "FL2", "FL3", "FL4", "FL5", "FL6", "FL7", "FL8", "FL9", "FL10", "FL11", "FL12", "HP1", "LED-B1", "LED-B2", "LED-B3",
    "LED-B4", "LED-B5", "LED-BH1", "LED-RGB1", "LED-V1", "LED-V2",
];

/// Wavelengths that the monochromator covers at least, and at most, nm.
const RANGE_NM: (f64, f64) = (300.0, 1100.0);
const WIDEST_NM: (f64, f64) = (200.0, 2500.0);
const PERCENT: f64 = 100.0;

/// The range of the monochromator for a sensor, whole nm.
pub(super) fn range_nm(sensor: &Sensor) -> (f64, f64) {
    let hulls = sensor.channels.iter().filter_map(|channel| channel.responsivity.support().hull());
    let inside = |nm: f64| (WIDEST_NM.0..=WIDEST_NM.1).contains(&nm);
    hulls.fold(RANGE_NM, |(low, high), (from, to)| {
        // What is unbounded says nothing about where to look.
        let low = if inside(from) { low.min(from.floor()) } else { low };
        (low, if inside(to) { high.max(to.ceil()) } else { high })
    })
}

/// Light that a channel sees: one line where it sees best, of whole nm. Directions are the same at every wavelength.
pub(super) fn seen_by(channel: &Channel) -> Result<Density, SheetError> {
    let wavelengths = (WIDEST_NM.0 as u32..=WIDEST_NM.1 as u32).map(f64::from);
    let best = wavelengths.max_by(|a, b| channel.responsivity.at(*a).total_cmp(&channel.responsivity.at(*b)));
    Ok(Density::line(best.unwrap_or(WIDEST_NM.0), 1.0)?)
}

/// Whether a channel reads an illuminance, of whatever receptor: the limits of classes are for those.
pub(super) fn is_illuminance(channel: &Channel) -> bool {
    let of_head = matches!(&channel.reads, Measurand::Weighted { .. }) && channel.reads.name().ends_with("cal illuminance");
    channel.reads == Measurand::Illuminance || of_head
}

/// Indices of one channel.
pub(super) fn characterise(bench: &Bench<'_>, full: &Sensor, index: usize, spectrogram: &Spectrogram) -> Result<ChannelSheet, SheetError> {
    let channel = &full.channels[index];
    let told = |error: MismatchError| SheetError::Spectral { channel: channel.name.clone(), error };
    let subject = Subject { bench, index, channel, sampled: Sampled::responsivity(spectrogram, index)? };
    let target = Target::of(channel);
    let (mut indices, mut lamps, mut absent) = (Vec::new(), Vec::new(), Vec::new());
    match &target {
        Some(target) => {
            indices.push(subject.mismatch(target).map_err(told)?);
            if target.photopic {
                indices.push(subject.behind_filter("u", "UV response", target, &Arrangement::ultraviolet()?, told)?);
                indices.push(subject.behind_filter("r", "IR response", target, &Arrangement::infrared()?, told)?);
            }
            lamps = subject.lamps(target, told)?;
        }
        None => {
            let why = format!("{} does not say what the channel is meant to weigh with", channel.reads.name());
            absent.extend(["f1′", "F"].map(|symbol| Absent { symbol, why: why.clone() }));
        }
    }
    let spectrum = target.as_ref().map_or_else(|| seen_by(channel), |target| Ok(target.calibration.clone()))?;
    let (of_readout, without) = readout::characterise(bench, full, index, &spectrum)?;
    indices.extend(of_readout.into_iter().map(|one| Index { limits: subject.limits(one.symbol), ..one }));
    absent.extend(without);
    indices.push(subject.mean_wavelength(target.as_ref()).map_err(told)?);
    Ok(ChannelSheet {
        name: channel.name.clone(),
        reads: channel.reads.clone(),
        target,
        indices,
        lamps,
        absent,
        responsivity: Responsivity { wavelengths_nm: spectrogram.wavelengths_nm.clone(), readings: spectrogram.readings[index].clone() },
        unknown: Vec::new(),
        class: None,
        total: None,
    })
}

/// A channel on the bench.
struct Subject<'a> {
    bench: &'a Bench<'a>,
    index: usize,
    channel: &'a Channel,
    sampled: Sampled,
}

impl Subject<'_> {
    /// Limits of classes, which are those of illuminance meters.
    fn limits(&self, symbol: &str) -> Option<&'static Limits> {
        if is_illuminance(self.channel) { limits(symbol) } else { None }
    }

    /// How much an index changes when the curve moves by its stated standard uncertainty: one cause at all wavelengths.
    fn stated(&self, index: impl Fn(&Factor) -> Result<f64, MismatchError>) -> Result<f64, MismatchError> {
        let own = index(&self.channel.responsivity)?;
        let mut u: f64 = 0.0;
        for stated in &self.channel.responsivity_uncertainty {
            // The same share at every wavelength is a scale, and scales cancel.
            if let ResponsivityUncertainty::Curve(curve) = stated {
                let moved = Factor::Sum(vec![self.channel.responsivity.clone(), curve.clone()]);
                u = u.hypot(index(&moved)? - own);
            }
        }
        Ok(u)
    }

    fn mismatch(&self, target: &Target) -> Result<Index, MismatchError> {
        let (from_nm, to_nm) = target.range_nm;
        let over = Wavelengths::Integral { from_nm, to_nm };
        let computed = mismatch_index(&self.channel.responsivity, &target.curve, &target.calibration, over)?;
        let measured = self.sampled.mismatch(&target.curve, &target.calibration, over)?;
        Ok(Index {
            symbol: "f1′",
            name: "spectral mismatch",
            unit: "%",
            computed: Figure::exact(computed, 1.0).scaled(PERCENT),
            measured: measured.scaled(PERCENT),
            limits: self.limits("f1_prime"),
            stated_u: self.stated(|curve| mismatch_index(curve, &target.curve, &target.calibration, over))? * PERCENT,
            conditions: format!("against {}, adjusted with {}, {from_nm} nm to {to_nm} nm", target.name, target.calibration_name),
        })
    }

    fn behind_filter(
        &self,
        symbol: &'static str,
        name: &'static str,
        target: &Target,
        arrangement: &Arrangement,
        told: impl Fn(MismatchError) -> SheetError,
    ) -> Result<Index, SheetError> {
        let responsivity = &self.channel.responsivity;
        let computed = response(responsivity, &target.curve, arrangement).map_err(&told)?;
        let share = share_behind(responsivity, arrangement).map_err(&told)?;
        let own = self.bench.share_behind(self.index, &arrangement.source, &arrangement.filter)?;
        let ideal = self.bench.share_of_standard(&target.curve, &arrangement.source, &arrangement.filter)?;
        let u = own.standard_uncertainty.hypot(ideal.standard_uncertainty);
        let measured = Figure { value: (own.value - ideal.value).abs(), standard_uncertainty: u };
        Ok(Index {
            symbol,
            name,
            unit: "%",
            computed: Figure::exact(computed, share).scaled(PERCENT),
            measured: measured.scaled(PERCENT),
            limits: self.limits(symbol),
            stated_u: self.stated(|curve| response(curve, &target.curve, arrangement)).map_err(&told)? * PERCENT,
            conditions: arrangement.words.clone(),
        })
    }

    fn lamps(&self, target: &Target, told: impl Fn(MismatchError) -> SheetError) -> Result<Vec<Lamp>, SheetError> {
        let adjusted = self.bench.over_truth(self.index, &target.curve, &target.calibration)?;
        let mut lamps = Vec::with_capacity(LAMPS.len());
        for name in LAMPS {
            let Ok(spectrum) = library::density(name) else { continue };
            // A lamp without light where the target is has no mismatch.
            let seen = |curve: &Factor| spectrum.integral(&[curve]) > 0.0;
            if !(seen(&target.curve) && seen(&self.channel.responsivity)) {
                continue;
            }
            let computed = correction_factor(&self.channel.responsivity, &target.curve, &spectrum, &target.calibration).map_err(&told)?;
            let over = self.bench.over_truth(self.index, &target.curve, &spectrum)?;
            let value = adjusted.value / over.value;
            let relative = |f: &Figure| f.standard_uncertainty / f.value;
            let measured = Figure { value, standard_uncertainty: value * relative(&adjusted).hypot(relative(&over)) };
            lamps.push(Lamp { name: name.to_owned(), computed: Figure::exact(computed, computed), measured });
        }
        Ok(lamps)
    }

    fn mean_wavelength(&self, target: Option<&Target>) -> Result<Index, MismatchError> {
        let flat = Density::flat(WIDEST_NM.0, WIDEST_NM.1, 1.0)?;
        let (spectrum, words) = match target {
            Some(target) => (target.calibration.clone(), target.calibration_name),
            None => (flat, "equal energy"),
        };
        // Where the monochromator was.
        let Factor::Table(points) = &self.sampled.curve else { return Err(MismatchError::OutOfRange) };
        let (from_nm, to_nm) = points.range_nm();
        let spectrum = spectrum.filtered(&Factor::band(from_nm, to_nm, 1.0)?);
        let computed = mean_wavelength_nm(&self.channel.responsivity, &spectrum)?;
        Ok(Index {
            symbol: "λ̄",
            name: "mean (effective) wavelength",
            unit: "nm",
            computed: Figure::exact(computed, computed),
            measured: self.sampled.mean_wavelength_nm(&spectrum)?,
            limits: None,
            stated_u: self.stated(|curve| mean_wavelength_nm(curve, &spectrum))?,
            conditions: format!("∫ S s λ dλ / ∫ S s dλ, S: {words}, {from_nm} nm to {to_nm} nm"),
        })
    }
}
