#include "tinwright/io/write_graph.hpp"
