// SPDX-License-Identifier: Apache-2.0
#include "core/image_stb_memory.h"

#include <algorithm>
#include <cstdlib>

namespace lampyris {

namespace {

thread_local StbMemory* current = nullptr;

}  // namespace

StbMemory::StbMemory(size_t limit) : limit_(limit) { current = this; }

StbMemory::~StbMemory() {
  current = nullptr;
  for (const Block& b : blocks_) std::free(b.memory);
}

StbMemory::Block* StbMemory::find(const void* memory) {
  return &*std::find_if(blocks_.begin(), blocks_.end(),
                        [memory](const Block& b) { return b.memory == memory; });
}

void* StbMemory::reallocate(void* old, size_t bytes) {
  StbMemory& m = *current;
  if (!old) m.blocks_.push_back({nullptr, 0});
  Block& block = old ? *m.find(old) : m.blocks_.back();
  const size_t others = m.used_ - block.bytes;
  void* memory = nullptr;
  if (bytes <= m.limit_ - std::min(others, m.limit_))
    memory = old ? std::realloc(old, bytes) : std::calloc(1, bytes);
  if (!memory) {
    m.refused_ = true;
    if (!old) m.blocks_.pop_back();
    return nullptr;
  }
  block = {memory, bytes};
  m.used_ = others + bytes;
  return memory;
}

void StbMemory::release(void* memory) {
  if (!memory) return;
  Block* const block = current->find(memory);
  current->used_ -= block->bytes;
  *block = current->blocks_.back();
  current->blocks_.pop_back();
  std::free(memory);
}

}  // namespace lampyris
