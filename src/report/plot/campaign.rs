//! Error of a calibrated curve against the number of exposures, against noise and against run time; both axes logarithmic.
//!
//! ```text
//! solid   true error, RMS over seeds and nodes        dashed   claimed standard uncertainty        thin   slopes
//! ```

use crate::study::converge::campaign::{CampaignConvergence, CampaignLadder, CampaignRung, LadderKind};

use super::PlotError;
use super::chart::{Axis, Chart, Curve, Dash, Ink, Key, Point};
use super::convergence::{above, below, decades};

/// What stands on the horizontal axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Against {
    /// The number of exposures.
    Exposures,
    /// The noise of the readings.
    Noise,
    /// The processor time of tracing and fit.
    Time,
}

impl Against {
    /// All of them.
    pub const ALL: [Against; 3] = [Against::Exposures, Against::Noise, Against::Time];

    /// One word, for the name of a file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Against::Exposures => "exposures",
            Against::Noise => "noise",
            Against::Time => "time",
        }
    }

    fn ladders(self) -> &'static [LadderKind] {
        match self {
            Against::Exposures => &[LadderKind::Exposures],
            Against::Noise => &[LadderKind::Noise],
            Against::Time => &[LadderKind::Exposures, LadderKind::Samples],
        }
    }

    fn place(self, rung: &CampaignRung) -> f64 {
        match self {
            Against::Exposures => rung.parameter,
            Against::Noise => 100.0 * rung.parameter,
            Against::Time => rung.cpu_seconds,
        }
    }

    /// A slope to hold the errors to, and its name: readings of independent noise, and errors as large as the noise.
    fn slope(self) -> (f64, &'static str) {
        match self {
            Against::Exposures | Against::Time => (-0.5, "slope −1/2"),
            Against::Noise => (1.0, "slope 1"),
        }
    }
}

/// A picture of a study.
///
/// # Errors
/// If there is nothing to draw.
pub fn chart(study: &CampaignConvergence, against: Against) -> Result<Chart, PlotError> {
    let ladders: Vec<&CampaignLadder> = against.ladders().iter().filter_map(|kind| study.ladder(*kind)).collect();
    let (mut curves, mut points, mut ends) = (Vec::new(), Vec::new(), Vec::<[f64; 2]>::new());
    for (i, ladder) in ladders.iter().enumerate() {
        let placed = |y: fn(&CampaignRung) -> f64| -> Vec<[f64; 2]> {
            let mut all: Vec<[f64; 2]> = ladder.rungs.iter().map(|r| [against.place(r), 100.0 * y(r)]).collect();
            all.retain(|p| p.iter().all(|c| *c > 0.0 && c.is_finite()));
            all
        };
        let (error, claimed) = (placed(|r| r.error), placed(|r| r.claimed));
        ends.extend(error.iter().chain(&claimed));
        points.extend(error.iter().map(|at| Point { label: String::new(), at: *at, ink: Ink::Palette(i), radius: 0.7, written: false }));
        let name = match (ladders.len(), ladder.kind) {
            (1, _) => String::new(),
            (_, LadderKind::Samples) => "more samples".to_owned(),
            _ => "more exposures".to_owned(),
        };
        curves.push(Curve::new(&name, error, Ink::Palette(i)));
        curves.push(Curve::new(&format!("{name}, claimed"), claimed, Ink::Palette(i)).dashed(Dash::Dashed).unwritten());
    }
    let reach = |k: usize| ends.iter().fold((f64::INFINITY, 0.0f64), |(low, high), p| (low.min(p[k]), high.max(p[k])));
    let ((x_low, x_high), (y_low, y_high)) = (reach(0), reach(1));
    if x_low >= x_high {
        return Err(PlotError::Nothing { what: format!("{}: fewer than two rungs", against.name()) });
    }
    let (from, to, bottom, top) = (below(x_low), above(x_high), below(y_low), above(y_high));
    // The slope passes above the middle of the first ladder.
    let (exponent, name) = against.slope();
    if let Some(middle) = ladders.first().and_then(|l| l.rungs.get(l.rungs.len() / 2)) {
        let (x, y) = (against.place(middle), 250.0 * middle.error.max(middle.claimed));
        let at = |to: f64| [to, y * (to / x).powf(exponent)];
        let inside: Vec<[f64; 2]> =
            (0..=64).map(|i| at(from * (to / from).powf(f64::from(i) / 64.0))).filter(|p| (bottom..=top).contains(&p[1])).collect();
        if let [first, .., last] = inside[..] {
            curves.push(Curve::new(name, vec![first, last], Ink::Muted).behind());
        }
    }
    let law = ladders.iter().filter_map(|l| {
        let law = if against == Against::Time { l.error_by_time } else { l.error_by_parameter };
        law.map(|law| format!("{:+.2} ± {:.2}", law.exponent, law.standard_uncertainty).replace('-', "−"))
    });
    let slopes: Vec<String> = law.collect();
    let seeds = ladders.iter().flat_map(|l| &l.rungs).map(|r| r.seeds).max().unwrap_or(0);
    let found = if slopes.is_empty() { String::new() } else { format!("; slope of the true error {}", slopes.join(" and ")) };
    let subtitle = format!("RMS over {seeds} seeds and all nodes{found}");
    let x = match against {
        Against::Exposures => Axis::log("Number of exposures", "1", from, to),
        Against::Noise => Axis { ticks: decades(from, to), ..Axis::log("Noise over the largest reading, RMS", "%", from, to) },
        Against::Time => Axis::log("Processor time of a run", "s", from, to),
    };
    let y = Axis { ticks: decades(bottom, top), ..Axis::log("Error and uncertainty over the peak", "%", bottom, top) };
    let key = |text: &str, dash| Key { text: text.to_owned(), width: 1.0, dash };
    Ok(Chart {
        curves,
        points,
        keys: vec![key("true error", Dash::Solid), key("claimed uncertainty", Dash::Dashed)],
        ..Chart::new(&study.title, &subtitle, x, y)
    })
}
