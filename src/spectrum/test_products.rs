//! Products of one to eight reflectances on which a spectral quadrature is tried: `P̂(λ) = Π (ρᵢ(λ)/ρᵢ,max)^mᵢ`, and for bright
//! surfaces the sum of all their powers, `ρ/(1 − ρ)`: what the inside of a closed surface sends out in the end.
//!
//! Every reflectance is divided by its largest value at the points, so a dark paint is tested as hard as a light one. Powers of one,
//! then products of two, then drawn at random from a fixed sequence: even numbers place nodes, odd numbers are only looked at.

use super::Factor;

/// Most reflectances in a product.
const MAX_BOUNCES: usize = 8;

/// Number of products, over all kinds.
const MAX_PRODUCTS: usize = 160;

/// Reflectances from here on, and below one, are tried with the sum of all their powers.
const BRIGHT: f64 = 0.8;

/// Indices of the reflectances of a product; one may occur several times.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Product {
    members: Vec<usize>,
    /// Not the product but `ρ/(1 − ρ)` of its only member.
    endless: bool,
}

impl Product {
    fn of(members: Vec<usize>) -> Self {
        Self { members, endless: false }
    }
}

/// The products and their values at the points.
pub(super) struct TestProducts<'a> {
    reflectances: Vec<(&'a Factor, f64)>,
    products: Vec<Product>,
    brightest: Vec<f64>,
    values: Vec<f64>,
}

impl<'a> TestProducts<'a> {
    /// Products of `reflectances`, evaluated at `points_nm`.
    pub(super) fn new(reflectances: &[&'a Factor], points_nm: Vec<f64>) -> Self {
        let scaled = |factor: &&'a Factor| {
            let largest = points_nm.iter().map(|nm| factor.at(*nm).abs()).fold(0.0, f64::max);
            (*factor, if largest > 0.0 { 1.0 / largest } else { 1.0 })
        };
        let reflectances: Vec<_> = reflectances.iter().map(scaled).collect();
        let mut products = products(reflectances.len());
        let bright = |index: &usize| (BRIGHT..1.0).contains(&(1.0 / reflectances[*index].1));
        products.extend((0..reflectances.len()).filter(bright).map(|index| Product { members: vec![index], endless: true }));
        let largest = |product: &Product| match product.endless {
            true => 1.0,
            false => product.members.iter().map(|index| 1.0 / reflectances[*index].1).product(),
        };
        let brightest = products.iter().map(largest).collect();
        let mut tests = Self { reflectances, products, brightest, values: Vec::new() };
        let mut values = Vec::with_capacity(points_nm.len() * tests.products.len());
        let mut single = vec![0.0; tests.reflectances.len()];
        for nm in points_nm {
            for (value, (factor, scale)) in single.iter_mut().zip(&tests.reflectances) {
                *value = factor.at(nm) * scale;
            }
            values.extend(tests.products.iter().map(|product| tests.value(product, |index| single[index])));
        }
        tests.values = values;
        tests
    }

    /// A product from the scaled values of its members, at most one.
    fn value(&self, product: &Product, scaled: impl Fn(usize) -> f64) -> f64 {
        if !product.endless {
            return product.members.iter().map(|index| scaled(*index)).product();
        }
        // ρ/(1 − ρ) over the same at ρ_max = 1/scale.
        let index = product.members[0];
        let largest = 1.0 / self.reflectances[index].1;
        let rho = scaled(index) * largest;
        rho / (1.0 - rho) * (1.0 - largest) / largest
    }

    /// Whether the product with this number takes part in placing the nodes.
    pub(super) fn is_for_placing(&self, number: usize) -> bool {
        number.is_multiple_of(2) || self.is_endless(number)
    }

    /// Whether it is the sum of all powers of a reflectance.
    pub(super) fn is_endless(&self, number: usize) -> bool {
        self.products[number].endless
    }

    /// The products.
    pub(super) fn products(&self) -> &[Product] {
        &self.products
    }

    /// How many of the first products are single reflections, one a reflectance in their order.
    pub(super) fn singles(&self) -> usize {
        self.reflectances.len().min(self.products.len())
    }

    /// The reflectances in a product that have a single reflection among the products.
    pub(super) fn members(&self, product: usize) -> Vec<usize> {
        self.products[product].members.iter().copied().filter(|member| *member < self.singles()).collect()
    }

    /// The values of all products at the point of this number.
    pub(super) fn at_point(&self, point: usize) -> &[f64] {
        &self.values[point * self.products.len()..][..self.products.len()]
    }

    /// `P_max` of each product: the product of the largest values of its reflectances at the points.
    pub(super) fn brightest(&self) -> &[f64] {
        &self.brightest
    }

    /// The value of a product at a wavelength.
    pub(super) fn at(&self, product: &Product, nm: f64) -> f64 {
        self.value(product, |index| self.reflectances[index].0.at(nm) * self.reflectances[index].1)
    }
}

/// The list of products of `count` reflectances; the same every time.
fn products(count: usize) -> Vec<Product> {
    let mut products = Vec::new();
    if count == 0 {
        return products;
    }
    for bounces in [1, MAX_BOUNCES, 2, 4] {
        products.extend((0..count).map(|index| Product::of(vec![index; bounces])));
    }
    products.truncate(MAX_PRODUCTS / 2);
    // A linear congruential sequence (Knuth, MMIX); its upper bits choose length and members.
    let mut state = 1_u64;
    let mut draw = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) as usize) % below
    };
    while products.len() < MAX_PRODUCTS.min(40 * count) {
        let bounces = 1 + draw(MAX_BOUNCES);
        // Half of the paths go to and fro between two surfaces, as light between neighbouring walls does.
        let pair = [draw(count), draw(count)];
        let two_only = draw(2) == 0;
        products.push(Product::of((0..bounces).map(|_| if two_only { pair[draw(2)] } else { draw(count) }).collect()));
    }
    products
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_the_same_every_time_and_limited() {
        for count in [0, 1, 4, 24, 1000] {
            let list = products(count);
            assert_eq!(list, products(count));
            assert!(list.len() <= MAX_PRODUCTS);
            assert!(list.iter().all(|product| (1..=MAX_BOUNCES).contains(&product.members.len())));
            assert!(list.iter().flat_map(|product| &product.members).all(|index| *index < count));
        }
    }
}
