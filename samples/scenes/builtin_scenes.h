#pragma once
// One function a built-in scene; each has a file of its own.
#include "licht/scene/scene.h"

namespace licht {

Scene makeCornell();
Scene makeFurnace();
Scene makeGallery();
Scene makeEmpty();

}  // namespace licht
