// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/film.h"

namespace lampyris {

const FilmRegistry& filmRegistry();

}  // namespace lampyris
