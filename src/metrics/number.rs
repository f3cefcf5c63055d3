//! A number that survives JSON, which has neither NaN nor infinity.

use serde::{Deserialize, Serialize};

/// Written as a JSON number, or as the text `NaN`, `inf` or `-inf`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(from = "Raw", into = "Raw")]
pub struct Number(pub f64);

#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Raw {
    Finite(f64),
    Other(String),
}

impl From<Raw> for Number {
    fn from(raw: Raw) -> Number {
        Number(match raw {
            Raw::Finite(x) => x,
            Raw::Other(text) => text.parse().unwrap_or(f64::NAN),
        })
    }
}

impl From<Number> for Raw {
    fn from(Number(x): Number) -> Raw {
        if x.is_finite() { Raw::Finite(x) } else { Raw::Other(x.to_string()) }
    }
}

impl From<f64> for Number {
    fn from(x: f64) -> Number {
        Number(x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_round_trips() {
        for x in [0.0, -1.5, 0.16, 1e10, f64::INFINITY, f64::NEG_INFINITY] {
            let text = serde_json::to_string(&Number(x)).unwrap();
            assert_eq!(serde_json::from_str::<Number>(&text).unwrap(), Number(x), "{text}");
        }
        let text = serde_json::to_string(&Number(f64::NAN)).unwrap();
        assert!(serde_json::from_str::<Number>(&text).unwrap().0.is_nan(), "{text}");
    }
}
