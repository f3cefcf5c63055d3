//! Number types of a walk: single precision as on a device, double precision as the reference, and both side by side.

use std::{
    cmp::Ordering,
    fmt::Debug,
    ops::{Add, Div, Mul, Neg, Sub},
};

use crate::ir::Math;

/// The float type of a walk.
pub trait Float:
    Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// True if each number has a double-precision shadow.
    const IS_SHADOWED: bool = false;

    /// Returns the number of these bits of single precision.
    fn from_bits(bits: u32) -> Self;
    fn from_f64(value: f64) -> Self;
    /// Returns the nearest number of single precision.
    fn to_f32(self) -> f32;
    fn to_f64(self) -> f64;
    /// Returns the shadow in double precision; the number itself if there is none.
    fn shadow(self) -> f64;
    /// Returns a number with this shadow, which is dropped if the type has none.
    fn with_shadow(value: f64, shadow: f64) -> Self;
    /// Computes a function of chapter 8 of one number.
    fn unary(self, fun: Math) -> Self;
    /// Computes a function of chapter 8 of two numbers.
    fn binary(self, fun: Math, other: Self) -> Self;
}

macro_rules! real {
    ($float:ident) => {
        impl Float for $float {
            fn from_bits(bits: u32) -> Self {
                f32::from_bits(bits).into()
            }

            fn from_f64(value: f64) -> Self {
                value as $float
            }

            fn to_f32(self) -> f32 {
                self as f32
            }

            fn to_f64(self) -> f64 {
                self.into()
            }

            fn shadow(self) -> f64 {
                self.into()
            }

            fn with_shadow(value: f64, _: f64) -> Self {
                value as $float
            }

            fn unary(self, fun: Math) -> Self {
                match fun {
                    Math::Abs => self.abs(),
                    Math::Sign if self > 0.0 => 1.0,
                    Math::Sign if self < 0.0 => -1.0,
                    Math::Sign => 0.0,
                    Math::Floor => self.floor(),
                    Math::Ceil => self.ceil(),
                    Math::Trunc => self.trunc(),
                    Math::Round => self.round_ties_even(),
                    Math::Fract => self - self.floor(),
                    Math::Saturate => self.max(0.0).min(1.0),
                    Math::Sqrt => self.sqrt(),
                    Math::InverseSqrt => 1.0 / self.sqrt(),
                    Math::Exp => self.exp(),
                    Math::Exp2 => self.exp2(),
                    Math::Log => self.ln(),
                    Math::Log2 => self.log2(),
                    Math::Radians => self.to_radians(),
                    Math::Degrees => self.to_degrees(),
                    Math::Sin => self.sin(),
                    Math::Cos => self.cos(),
                    Math::Tan => self.tan(),
                    Math::Asin => self.asin(),
                    Math::Acos => self.acos(),
                    Math::Atan => self.atan(),
                    Math::Sinh => self.sinh(),
                    Math::Cosh => self.cosh(),
                    Math::Tanh => self.tanh(),
                    Math::Asinh => self.asinh(),
                    Math::Acosh => self.acosh(),
                    Math::Atanh => self.atanh(),
                    other => unreachable!("{other:?} is no function of one number"),
                }
            }

            fn binary(self, fun: Math, other: Self) -> Self {
                match fun {
                    Math::Min => self.min(other),
                    Math::Max => self.max(other),
                    Math::Atan2 => self.atan2(other),
                    // Section 8.2: undefined below zero, where a device that uses logarithms returns NaN.
                    Math::Pow if self < 0.0 => $float::NAN,
                    Math::Pow => self.powf(other),
                    other => unreachable!("{other:?} is no function of two numbers"),
                }
            }
        }
    };
}

real!(f32);
real!(f64);

/// One number in both precisions. Control flow is decided by the single precision, so that both take the same path.
#[derive(Clone, Copy, Debug)]
pub struct Shadowed {
    pub single: f32,
    pub double: f64,
}

impl Shadowed {
    /// Returns a number that both precisions represent; one that single precision lacks is rounded there.
    pub fn exact(value: f64) -> Self {
        Self { single: value as f32, double: value }
    }
}

impl PartialEq for Shadowed {
    fn eq(&self, other: &Self) -> bool {
        self.single == other.single
    }
}

impl PartialOrd for Shadowed {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.single.partial_cmp(&other.single)
    }
}

macro_rules! arithmetic {
    ($($name:ident $method:ident $op:tt;)*) => {$(
        impl $name for Shadowed {
            type Output = Self;

            fn $method(self, other: Self) -> Self {
                Self { single: self.single $op other.single, double: self.double $op other.double }
            }
        }
    )*};
}

arithmetic! {
    Add add +;
    Sub sub -;
    Mul mul *;
    Div div /;
}

impl Neg for Shadowed {
    type Output = Self;

    fn neg(self) -> Self {
        Self { single: -self.single, double: -self.double }
    }
}

impl Float for Shadowed {
    const IS_SHADOWED: bool = true;

    fn from_bits(bits: u32) -> Self {
        Self { single: f32::from_bits(bits), double: f32::from_bits(bits).into() }
    }

    fn from_f64(value: f64) -> Self {
        Self::exact(value)
    }

    fn to_f32(self) -> f32 {
        self.single
    }

    fn to_f64(self) -> f64 {
        self.single.into()
    }

    fn shadow(self) -> f64 {
        self.double
    }

    fn with_shadow(value: f64, shadow: f64) -> Self {
        Self { single: value as f32, double: shadow }
    }

    fn unary(self, fun: Math) -> Self {
        Self { single: self.single.unary(fun), double: self.double.unary(fun) }
    }

    fn binary(self, fun: Math, other: Self) -> Self {
        Self { single: self.single.binary(fun, other.single), double: self.double.binary(fun, other.double) }
    }
}

/// A scalar. Its type is determined by the value that it is part of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell<R> {
    Float(R),
    /// An int or uint; a bool as 0 or 1.
    Bits(u32),
}

impl<R: Float> Cell<R> {
    pub fn float(self) -> R {
        match self {
            Cell::Float(value) => value,
            Cell::Bits(bits) => R::from_bits(bits),
        }
    }

    /// Returns the bits of an int, uint or bool; for a float those of single precision.
    pub fn bits(self) -> u32 {
        match self {
            Cell::Float(value) => value.to_f32().to_bits(),
            Cell::Bits(bits) => bits,
        }
    }

    pub fn is_true(self) -> bool {
        self.bits() != 0
    }
}

impl<R> From<bool> for Cell<R> {
    fn from(value: bool) -> Self {
        Cell::Bits(value.into())
    }
}
