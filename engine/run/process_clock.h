#pragma once

namespace licht {

/// Seconds since this process was started by its parent, so that loading of libraries counts; from the first
/// static initialiser on where the system does not tell. The system's own resolution is a clock tick, usually
/// 10 ms.
double secondsSinceProcessStart();

}  // namespace licht
