#ifndef TINWRIGHT_IO_PROJ_HANDLES_HPP
#define TINWRIGHT_IO_PROJ_HANDLES_HPP

#include <memory>

#include <proj.h>

/// PROJ's objects, destroyed when their owner is. Each is used by one thread at a time, and its context has
/// to outlive it.
namespace tinwright::io {

struct ProjDeleter {
    void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
    void operator()(PJ* object) const { proj_destroy(object); }
    void operator()(PJ_OBJ_LIST* list) const { proj_list_destroy(list); }
    void operator()(PJ_AREA* area) const { proj_area_destroy(area); }
    void operator()(PJ_OPERATION_FACTORY_CONTEXT* factory) const {
        proj_operation_factory_context_destroy(factory);
    }
};

using ProjContext = std::unique_ptr<PJ_CONTEXT, ProjDeleter>;
using ProjObject = std::unique_ptr<PJ, ProjDeleter>;
using ProjList = std::unique_ptr<PJ_OBJ_LIST, ProjDeleter>;
using ProjArea = std::unique_ptr<PJ_AREA, ProjDeleter>;
using ProjFactory = std::unique_ptr<PJ_OPERATION_FACTORY_CONTEXT, ProjDeleter>;

}  // namespace tinwright::io

#endif
