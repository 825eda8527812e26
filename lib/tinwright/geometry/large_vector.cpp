#include "tinwright/geometry/large_vector.hpp"

#include <cstdlib>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace tinwright {

namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21U;

// Smaller arrays would waste too much of their last page.
bool is_large(std::size_t bytes) { return bytes >= 8 * kHugePage; }

}  // namespace

void* allocate_large(std::size_t bytes) {
    if (!is_large(bytes)) {
        return ::operator new(bytes);
    }
    const std::size_t rounded = (bytes + kHugePage - 1) / kHugePage * kHugePage;
    void* memory = std::aligned_alloc(kHugePage, rounded);
    if (memory == nullptr) {
        throw std::bad_alloc();
    }
#if defined(__linux__)
    // Advice only: where it is refused, ordinary pages do. The part of a last page beyond the array is left.
    (void)::madvise(memory, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
    return memory;
}

void release_large(void* memory, std::size_t bytes) noexcept {
    if (is_large(bytes)) {
        std::free(memory);  // NOLINT(cppcoreguidelines-no-malloc): std::aligned_alloc has no other way back
    } else {
        ::operator delete(memory);
    }
}

}  // namespace tinwright
