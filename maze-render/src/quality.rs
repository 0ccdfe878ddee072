//! How much work a pixel gets: everything on a graphics card, less on a driver that draws with the processor.

/// What is spent on a picture. Every tier shows the same things in the same places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    /// For drivers that draw with the processor: one sample of a texture and one of a map of the floor's light for each
    /// pixel, edges smoothed by drawing over them.
    Low,
    /// For graphics built into the processor.
    Medium,
    /// For graphics cards, and for pictures that may take their time.
    High,
}

/// What a tier turns up or down.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Detail {
    /// Samples a pixel where the adapter has as many. Four is the one count, beside one, that every adapter offers.
    pub(crate) n_samples: u32,
    /// Most texture samples along a slanted surface's long side, 1 to 16.
    pub(crate) anisotropy: u16,
    /// PCF taps of the shadow map along each side of a shadow's soft edge, at least 1.
    pub(crate) pcf_taps: u8,
    /// Side of the shadow map in texels. WebGL2 guarantees 2048: 0.015 units a texel on a 20-unit board, 0.15 on a
    /// 200-unit one.
    pub(crate) sun_map_side: u32,
}

impl Quality {
    /// From the cheapest to the best.
    pub const ALL: [Self; 3] = [Self::Low, Self::Medium, Self::High];

    /// What suits an adapter when the user has not chosen.
    pub fn for_adapter(adapter: &wgpu::AdapterInfo) -> Self {
        match adapter.device_type {
            wgpu::DeviceType::Cpu => Self::Low,
            wgpu::DeviceType::DiscreteGpu => Self::High,
            // Built in, or a browser or a virtual machine that does not report it.
            _ => Self::Medium,
        }
    }

    /// `low`, `medium`, `high`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Low => "low",
            Self::Medium => "medium",
            Self::High => "high",
        }
    }

    /// The next cheaper one; none below the cheapest.
    pub fn cheaper(self) -> Option<Self> {
        match self {
            Self::Low => None,
            Self::Medium => Some(Self::Low),
            Self::High => Some(Self::Medium),
        }
    }

    /// The next better one; after the best the cheapest.
    pub fn next(self) -> Self {
        match self {
            Self::Low => Self::Medium,
            Self::Medium => Self::High,
            Self::High => Self::Low,
        }
    }

    /// Whether the tier computes in light, and so wants a target that turns light into sRGB itself. The low tier
    /// computes in sRGB: the driver's conversion would cost it a tenth of its time.
    pub fn wants_srgb_target(self) -> bool {
        self != Self::Low
    }

    /// The format to make a [`crate::Renderer`] for when it draws pictures only.
    pub fn picture_format(self) -> wgpu::TextureFormat {
        let format = crate::CAPTURE_FORMAT;
        if self.wants_srgb_target() { format } else { format.remove_srgb_suffix() }
    }

    pub(crate) fn detail(self, device: wgpu::DeviceType) -> Detail {
        let high = Detail { n_samples: 4, anisotropy: 16, pcf_taps: 3, sun_map_side: 2048 };
        let detail = match self {
            Self::Low => Detail { n_samples: 1, anisotropy: 1, pcf_taps: 1, sun_map_side: 1 },
            Self::Medium => Detail { anisotropy: 4, pcf_taps: 2, ..high },
            Self::High => high,
        };
        // A driver that draws with the processor visits every texel in the pixel's footprint, whatever the limit (Mesa's
        // llvmpipe): a wall seen nearly edge on has held up a frame for minutes.
        let anisotropy = if device == wgpu::DeviceType::Cpu { 1 } else { detail.anisotropy };
        Detail { anisotropy, ..detail }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_software_driver_never_gets_anisotropic_filtering() {
        for quality in Quality::ALL {
            assert_eq!(quality.detail(wgpu::DeviceType::Cpu).anisotropy, 1);
        }
        assert_eq!(Quality::High.detail(wgpu::DeviceType::DiscreteGpu).anisotropy, 16);
    }
}
