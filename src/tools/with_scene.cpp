// SPDX-License-Identifier: Apache-2.0
#include "tools/with_scene.h"

#include "tools/arguments.h"
#include "tools/messages.h"

namespace lampyris {

int withScene(bool quiet, const std::function<void(SourceFiles&, Diagnostics&)>& work) {
  SourceFiles files;
  Diagnostics diagnostics(files, [quiet](const std::string& text) {
    if (!quiet) say("{}\n", text);
  });
  try {
    work(files, diagnostics);
    return kDone;
  } catch (const SceneError& e) {
    say("{}\n", formatMessage(files, e.location, "error", e.what()));
    return kSceneError;
  }
}

}  // namespace lampyris
