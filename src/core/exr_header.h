// SPDX-License-Identifier: Apache-2.0
/// The headers of an EXR file, read before the library reads them: it allocates what they ask for.
#pragma once

#include <string>
#include <string_view>

namespace lampyris {

/// Throws IoError unless each attribute lies within the file, and each part's pixels are no more
/// than a file of this size can hold.
void checkExrHeaders(const std::string& path, std::string_view bytes);

}  // namespace lampyris
