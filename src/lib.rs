//! **Étendue: put a modelled instrument into a modelled scene and read it, with a stated uncertainty.**
//!
//! A virtual photometer and sensor-simulation toolkit: library and command line. This page is the architecture.
//!
//! # The equation
//!
//! ```text
//! S = ∫λ ∫A ∫Ω  s(λ) · R(ω) · L_λ(x, ω, λ) · (ω · n)  dω dA dλ   →  readout  →  indication
//! ```
//!
//! `s(λ)` is the spectral responsivity of a channel, `R(ω)` the relative directional response (acceptance), `A` the aperture and `n` its
//! normal. A *sensor* is aperture × acceptance × channels × readout; an *instrument* is a sensor with a pose in a scene. Étendue,
//! area times projected solid angle, is what a light meter collects. Words of metrology are those of the GUM: measurand,
//! indication, standard uncertainty `u`, combined `u_c`, coverage factor `k`, expanded `U`; `Error` is a Rust error and never an
//! uncertainty.
//!
//! # From a file to a reading
//!
//! ```text
//! scene text ─scene::read_scene→ Scene ─plan::Plan::new→ Plan ─estimate::estimate→ Estimates ─measurement::measure→ Measurement ─report→ text
//!                   │                         └ explain
//!            every problem at once
//! ```
//!
//! ```
//! use etendue::{estimate, measurement, plan, scene};
//!
//! // A lamp of 100 cd, 2 m above an ideal meter: E = I / r² = 25 lx.
//! let scene = scene::scene_from_text(r#"Scene(
//!     sources: [(name: "lamp", shape: Point, at: (0, 0, 2), strength: Candela(100), spectrum: "A")],
//!     instruments: [(
//!         name: "meter", at: (0, 0, 0), facing: (0, 0, 1),
//!         sensor: Sensor(title: "ideal", aperture: Point, acceptance: Cosine,
//!                        channels: [(name: "E_v", responsivity: "V", reads: Illuminance)]),
//!     )],
//! )"#)?;
//! let plan = plan::Plan::new(&scene, &plan::PlanOptions::default())?;
//! let watch = estimate::Watch { now: &|| 0.0, progress: &|_| {} };
//! let measured = measurement::measure(&scene, &plan, &estimate::Stop::default(), 0, &watch)?;
//! let reading = &measured.readings[0];
//! assert!((reading.value - 25.0).abs() <= reading.expanded.expanded_uncertainty);
//! assert_eq!((reading.measurand.unit(), reading.samples), ("lx", 0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Layers
//!
//! Imports point down only; `tests/architecture.rs` reads them.
//!
//! | layer | module | belongs here | never here |
//! |---|---|---|---|
//! | 0 | [`quantity`] | the lecture's table of quantities and systems as types, constants, unit names | spectra, scenes |
//! | 0 | [`metrology`] | accumulators that merge, budgets, coverage, rounding | light, random numbers |
//! | 0 | [`naming`] | which of the allowed names was meant | what they name |
//! | 0 | [`math`] | vectors, frames, samplers as triples, random streams | units |
//! | 1 | [`spectrum`] | functions of wavelength, lines, exact product integrals, spectral quadrature, tables | what a curve means |
//! | 1 | [`geometry`] | shapes, rays, meshes, acceleration | materials, emission |
//! | 2 | [`source`] | where and how light is emitted | shadows, sensors |
//! | 2 | [`surface`] | what reflects | paths |
//! | 2 | [`observer`] | V(λ), cones, colour matching, α-opic; what a spectrum is to an eye | scenes |
//! | 2 | [`sensor`] | aperture, acceptance, channels, readout; lenses, pixels and their noise | tracing |
//! | 3 | [`scene`] | the file format, its checks, its messages; instruments and their poses | estimation, hidden defaults |
//! | 4 | [`plan`] | what will be computed, what is left out, and why; pure | rays, random numbers, clocks |
//! | 5 | [`estimate`] | numbers for the terms of a plan, with their spread | choosing methods, dropping terms |
//! | 6 | [`measurement`] | estimates → readings and pictures with budget and provenance; what an ideal instrument would indicate | printing |
//! | 7 | [`calibration`] | responsivity curves fitted to readings, with covariance and what the readings do not see | scenes, rays |
//! | 7 | [`characterization`] | quality indices from curves, from frames and on a virtual bench; calibration campaigns | fitting, printing |
//! | 7 | [`lecture`] | the equations of a lecture by name, each a call of the library | physics of its own |
//! | 8 | [`study`] | what readings are worth: reference cases, error against run time, coverage, what rules save, what a calibration finds | printing, clocks of its own |
//! | 9 | [`report`] | text, JSON, CSV, plots, image files | computing anything else |
//! | 10 | `bin/etendue` | arguments, files, screens | physics |
//!
//! # Invariants
//!
//! 1. **No result without an uncertainty.** A measurement carries seed and plan; each reading carries value, unit, budget, `u_c`,
//!    degrees of freedom, `U`, samples, seconds.
//! 2. **Never a silent zero.** A zero says why; samples that found nothing give an upper bound, not `0 ± 0`.
//! 3. **A plan is a partition.** Every term is kept or left out, and what is left out carries a reason and a bound; a bound that is
//!    not zero becomes a row of the budget. Checked after every rule.
//! 4. **Same scene, same seed, same bits**, whatever the number of threads.
//! 5. **No absolute epsilon.** Scaling a scene by 1e-9 or 1e9 changes readings only as physics says.
//! 6. The library opens no file, prints nothing, reads no clock and no environment: text comes in through the trait
//!    [`scene::Files`], time through [`estimate::Watch`].
//! 7. No `unsafe` outside one SIMD file, no global mutable state, no panic on any input.
//! 8. Double precision everywhere a number is part of a result; single precision only to find which triangle of a mesh a ray meets.
//!
//! # Conventions
//!
//! Metres, watts, nanometres in air; right-handed, z up. Angles in degrees in files, in radians in memory; units are in the names. 683
//! lm/W at 540 THz gives K_m = 683.002 lm/W with V(λ) in air ([`quantity::constants`]); photons have the energy of their wavelength in
//! vacuum ([`spectrum::photometry`]). `R(ω)` does not contain the cosine; heads have
//! a weight w(ω) over all directions instead.

pub mod calibration;
pub mod characterization;
pub mod estimate;
pub mod geometry;
pub mod lecture;
pub mod math;
pub mod measurement;
pub mod metrology;
pub mod naming;
pub mod observer;
pub mod plan;
pub mod quantity;
pub mod report;
pub mod scene;
pub mod sensor;
pub mod source;
pub mod spectrum;
pub mod study;
pub mod surface;
