#include "licht/oidn/oidn.h"

namespace licht {

std::unique_ptr<Oidn> makeOidn() {
    return nullptr;
}

}  // namespace licht
