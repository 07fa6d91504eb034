//! Spectra in the XML of IES TM-27-14, files that end in `.spdx`.
//!
//! ```text
//! <IESTM2714 xmlns="iestm2714" version="1.0">
//!   <Header> <Description>my lamp</Description> <DocumentCreator/> <DocumentCreationDate/> … </Header>
//!   <SpectralDistribution>
//!     <SpectralQuantity>flux</SpectralQuantity>
//!     <SpectralData wavelength="380">0.012</SpectralData> …
//! ```
//!
//! | quantity | unit | is a |
//! |---|---|---|
//! | flux | W nm⁻¹ | density |
//! | intensity | W sr⁻¹ nm⁻¹ | density |
//! | irradiance, exitance | W m⁻² nm⁻¹ | density |
//! | radiance | W m⁻² sr⁻¹ nm⁻¹ | density |
//! | absorptance, reflectance, transmittance, R-Factor, T-Factor | 1 | factor |
//! | relative, other | not said | either |
//!
//! Wavelengths are in nm. Documents with a type definition are refused, so that no entity can grow; so are more than two million nodes and
//! elements nested deeper than 16.

mod read;
mod write;

pub use read::read;
pub use write::write;

use super::file::Meaning;

/// What the values of a file are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpectralQuantity {
    /// Spectral flux, W nm⁻¹.
    Flux,
    /// Spectral intensity, W sr⁻¹ nm⁻¹.
    Intensity,
    /// Spectral irradiance, W m⁻² nm⁻¹.
    Irradiance,
    /// Spectral radiance, W m⁻² sr⁻¹ nm⁻¹.
    Radiance,
    /// Spectral exitance, W m⁻² nm⁻¹.
    Exitance,
    /// Absorbed share.
    Absorptance,
    /// Reflected share.
    Reflectance,
    /// Transmitted share.
    Transmittance,
    /// Reflectance relative to a perfect diffuser, by a geometry.
    RFactor,
    /// Transmittance relative to a perfect diffuser, by a geometry.
    TFactor,
    /// A shape without a unit.
    Relative,
    /// Anything else.
    Other,
}

impl SpectralQuantity {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Flux,
        Self::Intensity,
        Self::Irradiance,
        Self::Radiance,
        Self::Exitance,
        Self::Absorptance,
        Self::Reflectance,
        Self::Transmittance,
        Self::RFactor,
        Self::TFactor,
        Self::Relative,
        Self::Other,
    ];

    /// The name in the file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flux => "flux",
            Self::Intensity => "intensity",
            Self::Irradiance => "irradiance",
            Self::Radiance => "radiance",
            Self::Exitance => "exitance",
            Self::Absorptance => "absorptance",
            Self::Reflectance => "reflectance",
            Self::Transmittance => "transmittance",
            Self::RFactor => "R-Factor",
            Self::TFactor => "T-Factor",
            Self::Relative => "relative",
            Self::Other => "other",
        }
    }

    /// The unit of the values, if the quantity has one.
    pub fn unit(self) -> Option<&'static str> {
        match self {
            Self::Flux => Some("W nm⁻¹"),
            Self::Intensity => Some("W sr⁻¹ nm⁻¹"),
            Self::Irradiance | Self::Exitance => Some("W m⁻² nm⁻¹"),
            Self::Radiance => Some("W m⁻² sr⁻¹ nm⁻¹"),
            Self::Absorptance | Self::Reflectance | Self::Transmittance | Self::RFactor | Self::TFactor => Some("1"),
            Self::Relative | Self::Other => None,
        }
    }

    /// Density or factor; `None` where either is possible.
    pub fn meaning(self) -> Option<Meaning> {
        match self {
            Self::Flux | Self::Intensity | Self::Irradiance | Self::Radiance | Self::Exitance => Some(Meaning::Density),
            Self::Absorptance | Self::Reflectance | Self::Transmittance | Self::RFactor | Self::TFactor => Some(Meaning::Factor),
            Self::Relative | Self::Other => None,
        }
    }

    /// The names of all quantities that may be used so.
    pub fn names_of(meaning: Meaning) -> Vec<&'static str> {
        Self::ALL.into_iter().filter(|quantity| quantity.meaning().is_none_or(|other| other == meaning)).map(Self::name).collect()
    }
}

/// Who measured what, when and how; all in words.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SpdxHeader {
    /// Manufacturer of what was measured.
    pub manufacturer: Option<String>,
    /// Its number in the catalogue.
    pub catalog_number: Option<String>,
    /// What was measured. The format asks for it; an empty element is written if it is not given.
    pub description: Option<String>,
    /// Who made the document. The format asks for it.
    pub document_creator: Option<String>,
    /// An identifier that no other document has.
    pub unique_identifier: Option<String>,
    /// What it was measured with.
    pub measurement_equipment: Option<String>,
    /// Where it was measured.
    pub laboratory: Option<String>,
    /// Number of the report.
    pub report_number: Option<String>,
    /// Date of the report.
    pub report_date: Option<String>,
    /// Date of the document. The format asks for it.
    pub document_creation_date: Option<String>,
    /// Anything else.
    pub comments: Option<String>,
}

/// Elements of the header, the keys by which they are listed, and whether the format asks for them.
const HEADER: [(&str, &str, bool); 11] = [
    ("Manufacturer", "manufacturer", false),
    ("CatalogNumber", "catalog_number", false),
    ("Description", "description", true),
    ("DocumentCreator", "document_creator", true),
    ("UniqueIdentifier", "unique_identifier", false),
    ("MeasurementEquipment", "measurement_equipment", false),
    ("Laboratory", "laboratory", false),
    ("ReportNumber", "report_number", false),
    ("ReportDate", "report_date", false),
    ("DocumentCreationDate", "document_creation_date", true),
    ("Comments", "comments", false),
];

impl SpdxHeader {
    /// The fields in the order of the format.
    fn fields(&self) -> [&Option<String>; 11] {
        [
            &self.manufacturer,
            &self.catalog_number,
            &self.description,
            &self.document_creator,
            &self.unique_identifier,
            &self.measurement_equipment,
            &self.laboratory,
            &self.report_number,
            &self.report_date,
            &self.document_creation_date,
            &self.comments,
        ]
    }

    fn fields_mut(&mut self) -> [&mut Option<String>; 11] {
        [
            &mut self.manufacturer,
            &mut self.catalog_number,
            &mut self.description,
            &mut self.document_creator,
            &mut self.unique_identifier,
            &mut self.measurement_equipment,
            &mut self.laboratory,
            &mut self.report_number,
            &mut self.report_date,
            &mut self.document_creation_date,
            &mut self.comments,
        ]
    }

    /// What is given, as (key, value), in the order of the format.
    pub fn entries(&self) -> Vec<(String, String)> {
        let rows = HEADER.iter().zip(self.fields());
        rows.filter_map(|((_, key, _), value)| Some(((*key).to_owned(), value.clone()?))).collect()
    }
}

/// A spectrum as the format has it.
#[derive(Debug, Clone, PartialEq)]
pub struct Spdx {
    /// Who, what, when.
    pub header: SpdxHeader,
    /// What the values are.
    pub quantity: SpectralQuantity,
    /// Line and column of the quantity in the file that was read, from 1.
    pub quantity_place: (usize, usize),
    /// Geometry of a reflectance: `0:0`, `di:0`, `de:0`, `0:di`, `0:de`, `d:d`, `other`.
    pub reflection_geometry: Option<String>,
    /// Geometry of a transmittance, as above.
    pub transmission_geometry: Option<String>,
    /// Full width at half maximum of the band of the instrument, nm.
    pub bandwidth_fwhm_nm: Option<f64>,
    /// Whether the values are corrected for that band.
    pub bandwidth_corrected: Option<bool>,
    /// Wavelengths, nm, strictly increasing, at least two.
    pub wavelengths_nm: Vec<f64>,
    /// The values, as many.
    pub values: Vec<f64>,
    /// What was left out when the file was read.
    pub remarks: Vec<String>,
}

#[cfg(test)]
mod tests;
