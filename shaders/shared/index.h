// Indices of nothing.
#ifndef LICHT_SHARED_INDEX_H
#define LICHT_SHARED_INDEX_H
#include "seam.h"

LICHT_SHARED_BEGIN

LICHT_CONSTANT uint kNoIndex = 0xffffffffu;

LICHT_SHARED_END
#endif
