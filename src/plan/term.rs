//! The terms of a measurand, and what can become of them.

use std::borrow::Cow;

use crate::source::{Emitter, Source};

/// How light gets from the source to the instrument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Transport {
    /// In a straight line.
    Direct,
    /// By way of at least one reflection.
    Reflected,
}

/// A term of the measurand: instrument channel × source × transport.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TermId {
    instrument: u32,
    channel: u32,
    /// How the light gets there.
    pub transport: Transport,
    source: u32,
}

impl TermId {
    /// The term with these indices into the scene.
    #[must_use]
    pub fn new(instrument: usize, channel: usize, source: usize, transport: Transport) -> TermId {
        // Scenes are limited to far fewer than 2^32 of anything when they are read.
        TermId { instrument: instrument as u32, channel: channel as u32, transport, source: source as u32 }
    }

    /// Index into `Scene::instruments`.
    #[must_use]
    pub fn instrument(&self) -> usize {
        self.instrument as usize
    }

    /// Index into the sensor's channels.
    #[must_use]
    pub fn channel(&self) -> usize {
        self.channel as usize
    }

    /// Index into `Scene::sources`.
    #[must_use]
    pub fn source(&self) -> usize {
        self.source as usize
    }
}

/// Whether something may stand between source and receiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Visibility {
    /// Rays find out.
    Tested,
    /// Proved clear: nothing can stand in the way.
    Clear,
}

/// How a term is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// A formula; no samples.
    ClosedForm,
    /// Deterministic quadrature of a formula over the aperture or the directional response; no samples.
    Quadrature,
    /// One connection from a point that receives to a source without extent.
    Connection,
    /// Points of the source and of the aperture are sampled and connected.
    SampledSource,
    /// Directions are sampled; those that meet nothing see the environment.
    SampledSky,
    /// Paths from the instrument, connected to a source at every reflection.
    Paths,
    /// The exact sum of all reflections in a closed sphere.
    ClosedSphere,
}

impl Method {
    /// The method of the naive plan.
    #[must_use]
    pub fn by_rays(source: &Source, transport: Transport) -> Method {
        match (transport, &source.emitter) {
            (Transport::Reflected, _) => Method::Paths,
            (Transport::Direct, Emitter::Environment) => Method::SampledSky,
            (Transport::Direct, _) => Method::SampledSource,
        }
    }

    /// The words of `explain`.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Method::ClosedForm => "closed form",
            Method::Quadrature => "deterministic quadrature",
            Method::Connection => "one connection",
            Method::SampledSource => "sample the source",
            Method::SampledSky => "sample the sky",
            Method::Paths => "paths with next-event estimation",
            Method::ClosedSphere => "closed sphere, all reflections summed",
        }
    }
}

/// A term that will be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Term {
    /// Which.
    pub id: TermId,
    /// Whether something may stand in the way.
    pub visibility: Visibility,
    /// How.
    pub method: Method,
}

impl Term {
    /// Whether rays are traced for it.
    #[must_use]
    pub fn needs_rays(&self) -> bool {
        match self.method {
            Method::ClosedForm | Method::Quadrature | Method::ClosedSphere => false,
            Method::Connection | Method::SampledSource => self.visibility == Visibility::Tested,
            Method::SampledSky | Method::Paths => true,
        }
    }
}

/// How large what is left out can be, in the unit of the reading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Proved to be nothing.
    Zero,
    /// At most this; becomes a type B row of the budget.
    AtMost(f64),
}

/// A term that is left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Omission {
    /// Which.
    pub id: TermId,
    /// By which rule.
    pub rule: &'static str,
    /// Why, in words.
    pub reason: Cow<'static, str>,
    /// How large it can be.
    pub bound: Bound,
}

/// Something that a rule made smaller without leaving a term out.
#[derive(Clone, Debug, PartialEq)]
pub struct Narrowing {
    /// By which rule.
    pub rule: &'static str,
    /// Index into `Scene::instruments`.
    pub instrument: usize,
    /// What became of what, and why.
    pub what: String,
}
