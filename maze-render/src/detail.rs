//! How much work a pixel gets: everything on a graphics card, less on a driver that draws with the processor.

/// What can be turned down without a scene looking different, only coarser.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Detail {
    /// Most texture samples along a slanted surface's long side, 1 to 16.
    pub anisotropy: u16,
    /// Looks at the sun's map along each side of a shadow's soft edge, at least 1.
    pub sun_looks: u8,
    /// Side of the sun's map in texels.
    pub sun_map_side: u32,
}

impl Detail {
    /// For graphics cards, and for pictures that may take their time.
    ///
    /// WebGL2 guarantees a map of 2048: 0.015 units a texel on a 20-unit board, 0.15 on a 200-unit one.
    pub const FULL: Self = Self { anisotropy: 16, sun_looks: 3, sun_map_side: 2048 };

    /// For software drivers: a frame takes 80 ms instead of 145 on lavapipe with two cores, 1280x720.
    pub const LOW: Self = Self { anisotropy: 1, sun_looks: 2, sun_map_side: 1024 };

    /// What suits an adapter when nobody says otherwise.
    pub fn for_adapter(adapter: &wgpu::AdapterInfo) -> Self {
        if adapter.device_type == wgpu::DeviceType::Cpu { Self::LOW } else { Self::FULL }
    }
}
