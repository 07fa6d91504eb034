//! Counter-based random numbers: (seed, stream, index, set) → four numbers in (0, 1).
//!
//! ```text
//! x = owen(sobol(owen(index, key), d), key_d)        d = 0 … 3, a new key for every set of four
//! ```
//!
//! Sobol points in four dimensions (direction numbers of Joe and Kuo 2008), Owen-scrambled by hashing (Laine and Karras 2011,
//! constants of Vegdahl 2021), the index shuffled by the same kind of scramble, and padded: dimensions 4 to 7 are again the
//! first four with another key (Burley, *Practical hash-based Owen scrambling*, JCGT 9, 2020). Dimensions are unlimited, indices
//! 32 bits. The first 2^m indices of a set are a (0, m, 2)-net in its leading two dimensions.
//!
//! The scramble acts on the reversed bits: a bit may depend on the more significant ones only, or the points lose their strata.

/// Number of lanes that are filled at once.
pub const LANES: usize = 16;

/// Direction numbers of the four dimensions with their bits reversed: `DIRECTIONS[bit][dimension]`.
const DIRECTIONS: [[u32; 4]; 32] = directions();

const fn directions() -> [[u32; 4]; 32] {
    // Joe and Kuo, new-joe-kuo-6: degree, coefficients, initial numbers of dimensions 2 to 4; dimension 1 is van der Corput.
    const DEGREE: [usize; 3] = [1, 2, 3];
    const COEFFICIENTS: [u32; 3] = [0, 1, 1];
    const INITIAL: [[u32; 3]; 3] = [[1, 0, 0], [1, 3, 0], [1, 3, 1]];
    let mut table = [[0u32; 4]; 32];
    let mut bit = 0;
    while bit < 32 {
        table[bit][0] = 1 << (31 - bit);
        bit += 1;
    }
    let mut d = 0;
    while d < 3 {
        let s = DEGREE[d];
        let mut bit = 0;
        while bit < 32 {
            table[bit][d + 1] = if bit < s {
                INITIAL[d][bit] << (31 - bit)
            } else {
                let mut v = table[bit - s][d + 1] ^ (table[bit - s][d + 1] >> s);
                let mut k = 1;
                while k < s {
                    if (COEFFICIENTS[d] >> (s - 1 - k)) & 1 == 1 {
                        v ^= table[bit - k][d + 1];
                    }
                    k += 1;
                }
                v
            };
            bit += 1;
        }
        d += 1;
    }
    let mut bit = 0;
    while bit < 32 {
        let mut d = 0;
        while d < 4 {
            table[bit][d] = table[bit][d].reverse_bits();
            d += 1;
        }
        bit += 1;
    }
    table
}

/// A bit of the result depends on the less significant bits of `x` only (Vegdahl's constants).
#[inline(always)]
fn scramble_reversed(mut x: u32, key: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(key);
    x = x.wrapping_mul((key >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x
}

/// SplitMix64's finaliser.
#[inline(always)]
const fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Wellons' lowbias32.
#[inline(always)]
const fn mix_32(mut x: u32) -> u32 {
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

#[inline(always)]
fn unit_interval(x: u32) -> f64 {
    // Half a step from either end: neither 0 nor 1 can come out.
    (f64::from(x) + 0.5) * (1.0 / 4_294_967_296.0)
}

/// An independent randomisation of the Sobol points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stream {
    key: u64,
}

impl Stream {
    /// The stream of a seed and a path of counters, e.g. (term, receiver, replicate).
    #[must_use]
    pub fn new(seed: u64, path: &[u64]) -> Stream {
        let start = Stream { key: mix(seed.wrapping_add(0x9e37_79b9_7f4a_7c15)) };
        path.iter().fold(start, |stream, &part| stream.child(part))
    }

    /// The stream one counter further down.
    #[inline]
    #[must_use]
    pub fn child(self, part: u64) -> Stream {
        Stream { key: mix(self.key.wrapping_add(part.wrapping_mul(0x9e37_79b9_7f4a_7c15)).wrapping_add(0x632b_e59b_d9b4_e019)) }
    }

    /// One number in (0, 1) of the stream's own, independent of its points.
    #[inline]
    #[must_use]
    pub fn number(self) -> f64 {
        unit_interval((mix(self.key ^ 0x5851_f42d_4c95_7f2d) >> 32) as u32)
    }

    /// 64 random bits: number `counter` of a sequence of the stream's own, without the strata of its points. For noise, where every
    /// number has to be independent of every other.
    #[inline(always)]
    #[must_use]
    pub fn bits(self, counter: u64) -> u64 {
        mix(self.key.wrapping_add((counter << 1 | 1).wrapping_mul(0xd6e8_feb8_6659_fd93)))
    }

    /// Keys of the index and of the four dimensions of a set.
    #[inline(always)]
    fn keys(self, set: u32) -> [u32; 5] {
        let whole = mix(self.key ^ (u64::from(set) << 1 | 1).wrapping_mul(0xd6e8_feb8_6659_fd93));
        let (low, high) = (whole as u32, (whole >> 32) as u32);
        [low, high, mix_32(low ^ 0x9e37_79b9), mix_32(high ^ 0x7f4a_7c15), mix_32(low.wrapping_add(high))]
    }

    /// Four numbers in (0, 1): dimensions `4·set` to `4·set + 3` of point `index`.
    #[must_use]
    pub fn four(self, index: u32, set: u32) -> [f64; 4] {
        let keys = self.keys(set);
        let shuffled = scramble_reversed(index.reverse_bits(), keys[0]).reverse_bits();
        let mut reversed = [0u32; 4];
        for (bit, directions) in DIRECTIONS.iter().enumerate() {
            let mask = 0u32.wrapping_sub((shuffled >> bit) & 1);
            for d in 0..4 {
                reversed[d] ^= directions[d] & mask;
            }
        }
        std::array::from_fn(|d| unit_interval(scramble_reversed(reversed[d], keys[d + 1]).reverse_bits()))
    }
}

/// The same as [`Stream::four`] for many lanes at once, each with its own stream, index and set: `result[dimension][lane]`.
#[inline(always)]
pub fn four_in_lanes(streams: &[Stream; LANES], indices: &[u32; LANES], sets: &[u32; LANES], result: &mut [[f64; LANES]; 4]) {
    let mut keys = [[0u32; LANES]; 5];
    for lane in 0..LANES {
        let k = streams[lane].keys(sets[lane]);
        for (row, key) in keys.iter_mut().zip(k) {
            row[lane] = key;
        }
    }
    let mut shuffled = [0u32; LANES];
    for lane in 0..LANES {
        shuffled[lane] = scramble_reversed(indices[lane].reverse_bits(), keys[0][lane]).reverse_bits();
    }
    let mut reversed = [[0u32; LANES]; 4];
    for (bit, directions) in DIRECTIONS.iter().enumerate() {
        for lane in 0..LANES {
            let mask = 0u32.wrapping_sub((shuffled[lane] >> bit) & 1);
            reversed[0][lane] ^= directions[0] & mask;
            reversed[1][lane] ^= directions[1] & mask;
            reversed[2][lane] ^= directions[2] & mask;
            reversed[3][lane] ^= directions[3] & mask;
        }
    }
    for d in 0..4 {
        for lane in 0..LANES {
            result[d][lane] = unit_interval(scramble_reversed(reversed[d][lane], keys[d + 1][lane]).reverse_bits());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_elementary_interval_of_a_pair_holds_one_point() {
        for m in [4u32, 8] {
            let n = 1u32 << m;
            let stream = Stream::new(7, &[u64::from(m)]);
            let points: Vec<[f64; 4]> = (0..n).map(|i| stream.four(i, 3)).collect();
            for split in 0..=m {
                let (a, b) = (f64::from(1u32 << split), f64::from(1u32 << (m - split)));
                let mut seen = vec![false; n as usize];
                for p in &points {
                    let cell = (p[0] * a) as usize * b as usize + (p[1] * b) as usize;
                    assert!(!std::mem::replace(&mut seen[cell], true), "m = {m}, split {split}");
                }
            }
            for d in 2..4 {
                let mut seen = vec![false; n as usize];
                for p in &points {
                    assert!(!std::mem::replace(&mut seen[(p[d] * f64::from(n)) as usize], true));
                }
            }
        }
    }

    #[test]
    fn lanes_and_single_points_are_the_same_numbers() {
        let streams = std::array::from_fn(|i| Stream::new(1, &[i as u64 / 3]));
        let indices = std::array::from_fn(|i| 1000 + 17 * i as u32);
        let sets = std::array::from_fn(|i| i as u32 % 5);
        let mut lanes = [[0.0; LANES]; 4];
        four_in_lanes(&streams, &indices, &sets, &mut lanes);
        for lane in 0..LANES {
            let single = streams[lane].four(indices[lane], sets[lane]);
            for d in 0..4 {
                assert_eq!(single[d], lanes[d][lane]);
            }
        }
    }

    #[test]
    fn the_error_of_a_smooth_integral_falls_faster_than_independent_numbers_allow() {
        // ∫ Π (1 + (x − ½)) dx = 1 in four dimensions; root mean square over 32 scrambles.
        let rms = |n: u32| {
            let square: f64 = (0..32)
                .map(|seed| {
                    let stream = Stream::new(seed, &[]);
                    let mean: f64 = (0..n).map(|i| stream.four(i, 0).iter().map(|x| 0.5 + x).product::<f64>()).sum::<f64>() / f64::from(n);
                    (mean - 1.0).powi(2)
                })
                .sum();
            (square / 32.0).sqrt()
        };
        let (coarse, fine) = (rms(64), rms(4096));
        assert!(fine < coarse / 40.0, "64 points: {coarse:.2e}, 4096 points: {fine:.2e}");
    }

    #[test]
    fn bits_of_neighbouring_streams_and_counters_are_independent() {
        // Each of the 64 bits, and each pair of a bit with the same one of a neighbour, is as often 0 as 1.
        let n = 1 << 14;
        let stream = |i: u64| Stream::new(3, &[9]).child(i);
        for other in [0u64, 1, 2] {
            let mut ones = [0u32; 64];
            for i in 0..n {
                let bits = match other {
                    0 => stream(i).bits(0),
                    1 => stream(i).bits(0) ^ stream(i).bits(1),
                    _ => stream(i).bits(0) ^ stream(i + 1).bits(0),
                };
                for (bit, count) in ones.iter_mut().enumerate() {
                    *count += (bits >> bit & 1) as u32;
                }
            }
            let chi_squared: f64 = ones.iter().map(|&k| (f64::from(k) - 0.5 * n as f64).powi(2) / (0.25 * n as f64)).sum();
            // 64 degrees of freedom: mean 64, standard deviation 11.3.
            assert!((30.0..110.0).contains(&chi_squared), "{other}: {chi_squared}");
        }
    }

    #[test]
    fn padded_sets_are_independent() {
        let stream = Stream::new(5, &[]);
        let n = 4096;
        let covariance: f64 = (0..n).map(|i| (stream.four(i, 0)[0] - 0.5) * (stream.four(i, 1)[0] - 0.5)).sum::<f64>() / f64::from(n);
        assert!(covariance.abs() < 4.0 / 12.0 / f64::from(n).sqrt());
    }
}
