//! Numbers of 192 bits, as far as the reference needs them.

use dashu_float::FBig;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Bits of a result: 1e-58, against the 1e-16 of what is tested.
const BITS: usize = 192;

/// A binary number of 192 bits, which are three words.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub(crate) struct Big(FBig);

/// A point or a vector of the plane.
pub(crate) type Pair = [Big; 2];

macro_rules! operator {
    ($name:ident, $method:ident) => {
        operator!($name, $method, Big, Big);
        operator!($name, $method, Big, &Big);
        operator!($name, $method, &Big, Big);
        operator!($name, $method, &Big, &Big);
    };
    ($name:ident, $method:ident, $left:ty, $right:ty) => {
        impl $name<$right> for $left {
            type Output = Big;
            fn $method(self, other: $right) -> Big {
                Big((&self.0).$method(&other.0))
            }
        }
    };
}
operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for &Big {
    type Output = Big;
    fn neg(self) -> Big {
        Big(-self.0.clone())
    }
}

impl Neg for Big {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// The same number, exactly.
pub(crate) fn big(value: f64) -> Big {
    Big(FBig::try_from(value).unwrap().with_precision(BITS).value())
}

pub(crate) fn pair(value: [f64; 2]) -> Pair {
    value.map(big)
}

impl Big {
    pub(crate) fn sqrt(&self) -> Self {
        if self.sign() == Ordering::Equal { self.clone() } else { Self(self.0.sqrt()) }
    }

    pub(crate) fn half(self) -> Self {
        Self(self.0 >> 1)
    }

    pub(crate) fn abs(&self) -> Self {
        if self.sign() == Ordering::Less { -self } else { self.clone() }
    }

    /// Less than, equal to or greater than 0.
    pub(crate) fn sign(&self) -> Ordering {
        self.partial_cmp(&big(0.0)).unwrap()
    }

    /// To the nearest, or one beside it.
    pub(crate) fn f64(&self) -> f64 {
        self.0.to_f64().value()
    }
}

pub(crate) fn dot(a: &Pair, b: &Pair) -> Big {
    &a[0] * &b[0] + &a[1] * &b[1]
}

/// `a + b s`.
pub(crate) fn plus(a: &Pair, b: &Pair, s: &Big) -> Pair {
    [&a[0] + &b[0] * s, &a[1] + &b[1] * s]
}

pub(crate) fn minus(a: &Pair, b: &Pair) -> Pair {
    [&a[0] - &b[0], &a[1] - &b[1]]
}

/// Rounded.
pub(crate) fn length(a: &Pair) -> f64 {
    a[0].f64().hypot(a[1].f64())
}
