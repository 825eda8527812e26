#include "tinwright/breaklines/breakline.hpp"

namespace tinwright {

const char* role_name(LineRole role) {
    switch (role) {
        case LineRole::Breakline:
            return "breakline";
        case LineRole::Boundary:
            return "boundary";
        case LineRole::Hole:
            return "hole";
        case LineRole::Lake:
            return "lake";
        case LineRole::Bank:
            return "bank";
        case LineRole::River:
            return "river";
        default:
            return "section";
    }
}

}  // namespace tinwright
