//! Published results for the lid-driven cavity of side 1 whose lid has speed 1.
//!
//! Tables of U. Ghia, K. Ghia and C. Shin, J. Comput. Phys. 48 (1982), on 129 x 129 points, which differ from
//! high-order methods by up to .0063 in u and .0185 in v at Re = 1000: agreement beyond 1 % (u) and 2 % (v) is
//! meaningless. So methods are ranked by the extrema of high-order methods: of O. Botella and R. Peyret, Comput. Fluids
//! 27 (1998), for Re = 1000, and of C. Marchi, R. Suero and L. Araki, J. Braz. Soc. Mech. Sci. Eng. 31 (2009), for Re =
//! 100.

/// Reynolds numbers of the tables, in the order of their columns.
pub const REYNOLDS: [f64; 3] = [100.0, 400.0, 1000.0];

/// Table I: y, and u at x = 1/2 for each Reynolds number.
pub const U: [(f64, [f64; 3]); 15] = [
    (0.9766, [0.84123, 0.75837, 0.65928]),
    (0.9688, [0.78871, 0.68439, 0.57492]),
    (0.9609, [0.73722, 0.61756, 0.51117]),
    (0.9531, [0.68717, 0.55892, 0.46604]),
    (0.8516, [0.23151, 0.29093, 0.33304]),
    (0.7344, [0.00332, 0.16256, 0.18719]),
    (0.6172, [-0.13641, 0.02135, 0.05702]),
    (0.5, [-0.20581, -0.11477, -0.0608]),
    (0.4531, [-0.2109, -0.17119, -0.10648]),
    (0.2813, [-0.15662, -0.32726, -0.27805]),
    (0.1719, [-0.1015, -0.24299, -0.38289]),
    (0.1016, [-0.06434, -0.14612, -0.2973]),
    (0.0703, [-0.04775, -0.10338, -0.2222]),
    (0.0625, [-0.04192, -0.09266, -0.20196]),
    (0.0547, [-0.03717, -0.08186, -0.18109]),
];

/// Table II: x, and v at y = 1/2 for each Reynolds number.
pub const V: [(f64, [f64; 3]); 15] = [
    (0.9688, [-0.05906, -0.12146, -0.21388]),
    (0.9609, [-0.07391, -0.15663, -0.27669]),
    (0.9531, [-0.08864, -0.19254, -0.33714]),
    (0.9453, [-0.10313, -0.22847, -0.39188]),
    (0.9063, [-0.16914, -0.23827, -0.5155]),
    (0.8594, [-0.22445, -0.44993, -0.42665]),
    (0.8047, [-0.24533, -0.38598, -0.31966]),
    (0.5, [0.05454, 0.05186, 0.02526]),
    (0.2344, [0.17527, 0.30174, 0.32235]),
    (0.2266, [0.17507, 0.30203, 0.33075]),
    (0.1563, [0.16077, 0.28124, 0.37095]),
    (0.0938, [0.12317, 0.22965, 0.32627]),
    (0.0781, [0.1089, 0.2092, 0.30353]),
    (0.0703, [0.10091, 0.19713, 0.29012]),
    (0.0625, [0.09233, 0.1836, 0.27485]),
];

/// (x, Reynolds number) of the entry of [`V`] that is a misprint, -.23827: it is between -.44993 and -.22847, where
/// independent solvers find -.38. It is reported but not scored.
pub const SUSPECT: (f64, f64) = (0.9063, 400.0);

/// y, and u at x = 1/2, for Re = 1000 by a high-order method.
pub const U_HIGH: [(f64, f64); 15] = [
    (0.0547, -0.1812881),
    (0.0625, -0.20233),
    (0.0703, -0.2228955),
    (0.1016, -0.3004561),
    (0.1719, -0.388569),
    (0.2813, -0.2803696),
    (0.4531, -0.1081999),
    (0.5, -0.0620561),
    (0.6172, 0.0570178),
    (0.7344, 0.1886747),
    (0.8516, 0.3372212),
    (0.9531, 0.4723329),
    (0.9609, 0.5169277),
    (0.9688, 0.5808359),
    (0.9766, 0.6644227),
];

/// x, and v at y = 1/2, for Re = 1000 by a high-order method.
pub const V_HIGH: [(f64, f64); 15] = [
    (0.0625, 0.2807056),
    (0.0703, 0.2962703),
    (0.0781, 0.3099097),
    (0.0938, 0.3330442),
    (0.1563, 0.3769189),
    (0.2266, 0.3339924),
    (0.2344, 0.3253592),
    (0.5, 0.0257995),
    (0.8047, -0.3202137),
    (0.8594, -0.4264545),
    (0.9063, -0.5264392),
    (0.9453, -0.4103754),
    (0.9531, -0.3553213),
    (0.9609, -0.2936869),
    (0.9688, -0.2279225),
];

/// Returns the minimum u at x = 1/2, and the maximum and the minimum v at y = 1/2, by high-order methods; `None` where
/// none are available.
pub fn extrema(reynolds: f64) -> Option<[f64; 3]> {
    match reynolds {
        100.0 => Some([-0.2140424, 0.1795728, -0.2538030]),
        1000.0 => Some([-0.3885698, 0.3769447, -0.5270771]),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the largest difference of a column from a high-order method at the same places.
    fn apart(table: &[(f64, [f64; 3])], high: &[(f64, f64)]) -> f64 {
        let far = |(at, value): &(f64, f64)| {
            let row = table.iter().find(|(place, _)| place == at).unwrap();
            (row.1[2] - value).abs()
        };
        high.iter().map(far).fold(0.0, f64::max)
    }

    #[test]
    fn the_tables_differ_from_high_order_methods_by_the_published_amounts() {
        let (u, v) = (apart(&U, &U_HIGH), apart(&V, &V_HIGH));
        assert!((u - 0.0063).abs() < 1e-4 && (v - 0.0185).abs() < 1e-4, "{u} {v}");
        // The sampled extrema are within the true ones.
        for (n, reynolds) in REYNOLDS.into_iter().enumerate() {
            let Some([u_least, v_most, v_least]) = extrema(reynolds) else { continue };
            assert!(U.iter().all(|(_, u)| u[n] > u_least - 1e-4));
            assert!(V.iter().all(|(_, v)| v[n] < v_most + 1e-4 && v[n] > v_least - 1e-4));
        }
    }
}
