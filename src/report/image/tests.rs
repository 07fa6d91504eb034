//! What is written reads back bit for bit, by readers of the same crates and, for NPY, by the format's description.

use super::*;
use proptest::prelude::*;
use std::io::Cursor;

/// A picture of any size up to 40 × 40 with any samples.
fn pictures() -> impl Strategy<Value = (usize, usize, Vec<u16>)> {
    (1usize..40, 1usize..40).prop_flat_map(|(w, h)| (Just(w), Just(h), prop::collection::vec(any::<u16>(), w * h)))
}

fn decoded_png(bytes: &[u8]) -> (::png::OutputInfo, Vec<u8>) {
    let mut reader = ::png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
    let mut samples = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut samples).unwrap();
    samples.truncate(info.buffer_size());
    (info, samples)
}

proptest! {
    #[test]
    fn png_of_16_bits_reads_back((w, h, digital) in pictures()) {
        let (info, samples) = decoded_png(&png16(&digital, w, h).unwrap());
        prop_assert_eq!((info.width as usize, info.height as usize, info.bit_depth), (w, h, ::png::BitDepth::Sixteen));
        let read: Vec<u16> = samples.chunks(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
        prop_assert_eq!(read, digital);
    }

    #[test]
    fn png_of_colours_reads_back((w, h, digital) in pictures()) {
        let rgb: Vec<u8> = digital.iter().flat_map(|y| [*y as u8, (y >> 8) as u8, (y >> 4) as u8]).collect();
        let (info, samples) = decoded_png(&png8_rgb(&rgb, w, h).unwrap());
        prop_assert_eq!(info.color_type, ::png::ColorType::Rgb);
        prop_assert_eq!(samples, rgb);
    }

    #[test]
    fn tiff_reads_back((w, h, digital) in pictures()) {
        let mut decoder = ::tiff::decoder::Decoder::new(Cursor::new(tiff16(&digital, w, h).unwrap())).unwrap();
        prop_assert_eq!(decoder.dimensions().unwrap(), (w as u32, h as u32));
        let ::tiff::decoder::DecodingResult::U16(read) = decoder.read_image().unwrap() else { panic!("no 16 bits") };
        prop_assert_eq!(read, digital);
    }

    #[test]
    fn exr_reads_back_by_names((w, h, digital) in pictures()) {
        use ::exr::prelude::{ReadChannels, ReadLayers, read};
        let bits = |mask: u32| -> Vec<f32> { digital.iter().map(|y| f32::from(*y) * 1.2345e-3 + mask as f32).collect() };
        let (green, blue) = (bits(1), bits(77));
        let bytes = exr(&[("green", &green), ("blue", &blue)], w, h).unwrap();
        let image = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer().all_attributes();
        let image = image.from_buffered(Cursor::new(bytes)).unwrap();
        prop_assert_eq!(image.layer_data.size, ::exr::math::Vec2(w, h));
        for (name, expected) in [("green", &green), ("blue", &blue)] {
            let channel = image.layer_data.channel_data.list.iter().find(|c| c.name.eq(name)).unwrap();
            let read: Vec<f32> = channel.sample_data.values_as_f32().collect();
            prop_assert_eq!(&read, expected);
        }
    }

    #[test]
    fn npy_holds_shape_and_numbers((w, h, digital) in pictures()) {
        let numbers: Vec<f32> = digital.iter().map(|y| f32::from(*y) / 7.0).collect();
        let bytes = npy_f32(&numbers, &[h, w]).unwrap();
        let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        let header = std::str::from_utf8(&bytes[10..10 + length]).unwrap();
        prop_assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
        prop_assert!((10 + length) % 64 == 0 && header.ends_with('\n'));
        let expected = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({h}, {w},), }}");
        prop_assert_eq!(header.trim_end(), expected);
        let read: Vec<f32> = bytes[10 + length..].chunks(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        prop_assert_eq!(read, numbers);
    }
}

#[test]
fn numbers_that_are_none_and_64_bits_survive() {
    let bytes = npy_f64(&[f64::NAN, -0.0, 1.0 / 3.0], &[3]).unwrap();
    assert!(bytes.ends_with(&(1.0f64 / 3.0).to_le_bytes()) && bytes.len() == 128 + 24);
    assert!(String::from_utf8_lossy(&bytes).contains("'<f8', 'fortran_order': False, 'shape': (3,), }"));
}

#[test]
fn samples_that_do_not_fill_the_picture_are_refused() {
    let words = |result: Result<Vec<u8>, ImageError>| result.unwrap_err().to_string();
    assert!(words(png16(&[1, 2, 3], 2, 2)).contains("3 samples for a picture of 2 × 2 pixels; 1 for each"));
    assert!(words(png8_rgb(&[1, 2, 3], 2, 1)).contains("3 for each pixel"));
    assert!(words(tiff16(&[], 0, 5)).contains("at least one pixel"));
    assert!(words(npy_f32(&[1.0], &[2, 1])).contains("do not fill the shape [2, 1]"));
    assert!(words(exr(&[("R", &[1.0]), ("R", &[1.0])], 1, 1)).contains("`R` is there twice"));
    assert!(words(exr(&[("", &[1.0])], 1, 1)).contains("no name"));
    assert!(words(exr(&[], 1, 1)).contains("missing"));
    assert!(words(exr(&[("R", &[1.0])], 1, 2)).contains("1 samples"));
}
