// SPDX-License-Identifier: Apache-2.0
#include "accelerators/embree_geometry.h"
