// SPDX-License-Identifier: Apache-2.0
// The one place that compiles stb's code. Formats that nobody asks for are left out: each is a
// parser of untrusted bytes. JPG files are read by libjpeg (image_jpeg.cpp).
#include "core/image_stb_memory.h"

#define STBI_NO_STDIO
#define STBI_MALLOC(bytes) lampyris::StbMemory::allocate(bytes)
#define STBI_REALLOC(block, bytes) lampyris::StbMemory::reallocate(block, bytes)
#define STBI_FREE(block) lampyris::StbMemory::release(block)
#define STBI_ONLY_PNG
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#define STBI_ONLY_HDR
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
