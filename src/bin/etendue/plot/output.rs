//! Where a picture goes and how it looks.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use etendue::report::plot::{self, Chart, SIDES_PX, Size, Style, Theme};

use super::bad;
use crate::{Failure, complain, disk};

/// Where the picture goes and how it looks.
#[derive(clap::Args)]
pub(super) struct Output {
    /// The file, `.svg` or `.png` [default: the kind's name `.svg` in this folder].
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Colours.
    #[arg(long, value_enum, default_value_t = ThemeName::Light)]
    theme: ThemeName,
    /// `paper` (170 mm wide), `column` (85 mm), `slide` (16:9), or WIDTHxHEIGHT in px.
    #[arg(long, value_parser = size, default_value = "paper")]
    size: Size,
    /// Pixels of a PNG to each px of the picture (1/96 inch).
    #[arg(long, value_parser = scale, default_value = "2", allow_hyphen_values = true)]
    scale: f64,
    /// Write the numbers that are drawn into this file, too.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum)]
enum ThemeName {
    /// Dark lines on white.
    Light,
    /// Light lines on near black.
    Dark,
}

fn size(given: &str) -> Result<Size, String> {
    let (least, most) = SIDES_PX;
    let side = |text: &str| text.trim().parse().ok().filter(|side| (least..=most).contains(side));
    match given.trim() {
        "paper" => Ok(Size::Paper),
        "column" => Ok(Size::Column),
        "slide" => Ok(Size::Slide),
        other => {
            let sides = other.split_once(['x', 'X', '×']).and_then(|(width, height)| Some((side(width)?, side(height)?)));
            let size = sides.map(|(width_px, height_px)| Size::Custom { width_px, height_px });
            size.ok_or_else(|| format!("paper, column, slide, or WIDTHxHEIGHT in px such as 1200x800, each side {least} to {most}"))
        }
    }
}

fn scale(given: &str) -> Result<f64, String> {
    given.trim().parse().ok().filter(|scale| (0.1..=20.0).contains(scale)).ok_or_else(|| "a number, 0.1 to 20".to_owned())
}

#[derive(Clone, Copy)]
enum Format {
    Svg,
    Png,
}

impl Format {
    fn of(target: &Path) -> Result<Self, Failure> {
        let extension = target.extension().map(|e| e.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("svg") => Ok(Self::Svg),
            Some("png") => Ok(Self::Png),
            found => {
                let found = found.map_or("no extension".to_owned(), |e| format!("`.{e}`"));
                let stem = target.with_extension("svg");
                Err(bad(format!("--out {}: found {found}; allowed: .svg, .png; for example --out {}", target.display(), stem.display())))
            }
        }
    }
}

impl Output {
    /// The size of the picture.
    pub(super) fn size(&self) -> Size {
        self.size
    }

    /// Draws a chart into its file and says which. A place that cannot be used is told before anything is computed.
    pub(super) fn draw(&self, kind: &str, chart: impl Fn() -> Result<Chart, Failure>) -> Result<(), Failure> {
        let target = self.out.clone().unwrap_or_else(|| PathBuf::from(format!("{kind}.svg")));
        let format = Format::of(&target)?;
        if self.csv.as_ref() == Some(&target) {
            return Err(bad(format!("--csv {}: that is the file of the picture; give the numbers a name of their own", target.display())));
        }
        let chart = chart()?;
        let theme = match self.theme {
            ThemeName::Light => Theme::Light,
            ThemeName::Dark => Theme::Dark,
        };
        let svg = plot::svg(&chart, &Style { theme, size: self.size }).map_err(bad)?;
        let drawn = match format {
            Format::Svg => svg.into_bytes(),
            Format::Png => plot::png(&svg, self.scale).map_err(bad)?,
        };
        save(&target, &drawn)?;
        match &self.csv {
            Some(table) => save(table, plot::csv(&chart).as_bytes()),
            None => Ok(()),
        }
    }
}

fn save(target: &Path, written: &[u8]) -> Result<(), Failure> {
    let help = "--out and --csv take a file in a folder that can be written";
    disk::save(target, written).map_err(|e| disk::unwritable(target, &e, help))?;
    complain(&format!("wrote {}", target.display()));
    Ok(())
}
