#pragma once
// What the Vulkan loader offers before there is an instance.

namespace licht::gpu {

bool layerInstalled(const char* layer);

/// A null layer asks the loader and its drivers.
bool offersExtension(const char* layer, const char* extension);

}  // namespace licht::gpu
