//! The folder of a data set: frames as 16-bit PNG, and the descriptor of them.

use std::path::Path;

use etendue::characterization::emva::Shot;
use etendue::report::emva::descriptor::Descriptor;
use etendue::report::image::png16;

use crate::file_set::FileSet;
use crate::{Failure, complain};

/// Folder of the frames beside the descriptor.
const FRAMES: &str = "images";
/// The descriptor.
const DESCRIPTOR: &str = "emva1288.txt";

/// A folder of frames with its descriptor.
pub(super) struct Archive<'f> {
    folder: &'f Path,
    descriptor: Descriptor,
    files: FileSet,
}

fn file_name(number: u64) -> String {
    format!("{number:05}.png")
}

impl<'f> Archive<'f> {
    pub(super) fn new(folder: &'f Path, frames: u64, descriptor: Descriptor) -> Result<Self, Failure> {
        let frames = (0..frames).map(|number| format!("{FRAMES}/{}", file_name(number)));
        let files = FileSet::new(folder, frames.chain([DESCRIPTOR.to_owned()]), "--out takes a folder that can be written")?;
        Ok(Archive { folder, descriptor, files })
    }

    pub(super) fn keep(&mut self, shot: &Shot, frame: &[u16], columns: usize, rows: usize) -> Result<(), Failure> {
        let name = file_name(shot.number);
        let png = png16(frame, columns, rows).map_err(|e| Failure::Run(format!("error: {e}")))?;
        self.files.add(&format!("{FRAMES}/{name}"), &png)?;
        self.descriptor.add(shot, FRAMES, &name);
        Ok(())
    }

    pub(super) fn finish(self) -> Result<(), Failure> {
        self.files.add(DESCRIPTOR, self.descriptor.text().as_bytes())?;
        self.files.finish()?;
        let target = self.folder.join(DESCRIPTOR);
        complain(&format!("note: frames and descriptor in {}", target.display()));
        Ok(())
    }
}
