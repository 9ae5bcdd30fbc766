#pragma once

#include "mms/text/key_table.hpp"

namespace tvbeam {

/// Every block and key that a scene may have. Scenes are read through it; the manual page
/// tvbeam-scene(5), the JSON schema of scenes, `tvbeam keys`, the completion of --set and the
/// features that shipped scenes must use are made of it.
const KeyTable& scene_keys();

} // namespace tvbeam
