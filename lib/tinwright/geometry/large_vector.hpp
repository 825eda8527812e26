#ifndef TINWRIGHT_GEOMETRY_LARGE_VECTOR_HPP
#define TINWRIGHT_GEOMETRY_LARGE_VECTOR_HPP

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace tinwright {

/// Memory for one large array: aligned to huge pages and marked for them where the system has them, which
/// saves a page fault every 4 KiB at first touch and most misses of the address translation afterwards.
/// Throws std::bad_alloc. `release_large` takes the same number of bytes.
void* allocate_large(std::size_t bytes);
void release_large(void* memory, std::size_t bytes) noexcept;

/// Allocator over `allocate_large` that leaves new elements uninitialised where their type allows.
template <class T>
struct LargeAllocator {
    using value_type = T;

    LargeAllocator() = default;
    template <class U>
    LargeAllocator(const LargeAllocator<U>& /*other*/) {}

    T* allocate(std::size_t count) {
        if (count > static_cast<std::size_t>(-1) / sizeof(T)) {
            throw std::bad_array_new_length();
        }
        return static_cast<T*>(allocate_large(count * sizeof(T)));
    }
    void deallocate(T* memory, std::size_t count) noexcept { release_large(memory, count * sizeof(T)); }

    template <class U>
    void construct(U* place) noexcept(std::is_nothrow_default_constructible_v<U>) {
        ::new (static_cast<void*>(place)) U;  // not U(): no zeros that are overwritten anyway
    }
    template <class U, class... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        std::construct_at(place, std::forward<Arguments>(arguments)...);
    }

    friend bool operator==(const LargeAllocator& /*a*/, const LargeAllocator& /*b*/) { return true; }
};

/// A vector for one entry a sample, vertex or face. `resize` leaves new entries of trivial types
/// uninitialised.
template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace tinwright

#endif
