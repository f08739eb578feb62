// SPDX-License-Identifier: Apache-2.0
#include "scene/builder.h"
