//! Which frame is which: the descriptor of a data set as the package emva1288 reads it.
//!
//! ```text
//! v 4.0
//! n BITS WIDTH HEIGHT
//! d EXPOSURE_NS                   frames in the dark follow
//! i images\0000.png
//! b EXPOSURE_NS PHOTONS           bright frames follow
//! i images\0001.png
//! ```
//!
//! Two frames of a line are temporal data, more are spatial data. Names are relative to the descriptor; a backslash parts folders.

use std::fmt::Write;

use crate::characterization::emva::Shot;

/// A descriptor that grows with the frames that are taken.
#[derive(Clone, Debug)]
pub struct Descriptor {
    text: String,
    last: Option<(f64, f64, bool)>,
}

impl Descriptor {
    /// Of frames of `bits` and `columns` × `rows` pixels; `comment` says in one line what they are.
    #[must_use]
    pub fn new(comment: &str, bits: u32, columns: usize, rows: usize) -> Descriptor {
        let comment: String = comment.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        Descriptor { text: format!("# {comment}\nv 4.0\nn {bits} {columns} {rows}\n"), last: None }
    }

    /// Adds a frame: frames of the same light, time and purpose are to follow each other.
    pub fn add(&mut self, shot: &Shot, folder: &str, file: &str) {
        let kind = (shot.exposure_s, shot.photons, shot.of_stack);
        // Writing to a string cannot fail.
        if self.last != Some(kind) {
            let nanoseconds = shot.exposure_s * 1e9;
            let _ = if shot.photons > 0.0 {
                writeln!(self.text, "b {nanoseconds} {}", shot.photons)
            } else {
                writeln!(self.text, "d {nanoseconds}")
            };
            self.last = Some(kind);
        }
        let _ = writeln!(self.text, "i {folder}\\{file}");
    }

    /// The file's text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_of_the_same_kind_share_a_line() {
        let mut descriptor = Descriptor::new("a camera\nof ours", 12, 128, 64);
        for (number, (photons, of_stack)) in
            [(0.0, false), (0.0, false), (250.5, false), (250.5, false), (0.0, true)].into_iter().enumerate()
        {
            let shot = Shot { exposure_s: 0.01, photons, number: number as u64, of_stack };
            descriptor.add(&shot, "images", &format!("{number}.png"));
        }
        let expected = "# a camera of ours\nv 4.0\nn 12 128 64\nd 10000000\ni images\\0.png\ni images\\1.png\nb 10000000 250.5\ni images\\2.png\n\
                        i images\\3.png\nd 10000000\ni images\\4.png\n";
        assert_eq!(descriptor.text(), expected);
    }
}
