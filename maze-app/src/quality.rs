//! How good the picture is to be, as chosen on the command line.

use crate::settings::QualitySetting;
use clap::ValueEnum;
use maze_render::{Gpu, Quality};

/// A tier, or the one that suits the adapter.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum QualityChoice {
    /// What the graphics adapter is fast enough for
    Auto,
    /// For drivers that draw with the processor
    Low,
    /// For graphics built into the processor
    Medium,
    /// For graphics cards
    High,
}

impl From<QualitySetting> for QualityChoice {
    fn from(setting: QualitySetting) -> Self {
        match setting {
            QualitySetting::Auto => Self::Auto,
            QualitySetting::Low => Self::Low,
            QualitySetting::Medium => Self::Medium,
            QualitySetting::High => Self::High,
        }
    }
}

impl QualityChoice {
    /// A tier that the user chose: it stays, however slow it is.
    pub(crate) fn is_chosen(self) -> bool {
        !matches!(self, Self::Auto)
    }

    pub(crate) fn on(self, gpu: &Gpu) -> Quality {
        match self {
            Self::Auto => Quality::for_adapter(&gpu.adapter_info),
            Self::Low => Quality::Low,
            Self::Medium => Quality::Medium,
            Self::High => Quality::High,
        }
    }
}
