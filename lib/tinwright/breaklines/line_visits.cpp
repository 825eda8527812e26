#include "tinwright/breaklines/line_visits.hpp"

#include <utility>

namespace tinwright {

LineVisits gather_visits(const LineWalk& walk, std::size_t lines, std::size_t vertices) {
    LineVisits visits;
    visits.start.resize(vertices + 1);
    for (std::size_t line = 0; line < lines; ++line) {
        walk.for_each_stop(line, [&](const LineStop& stop) { ++visits.start[stop.vertex + 1]; });
    }
    for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
        visits.start[vertex + 1] += visits.start[vertex];
    }
    visits.all.resize(visits.start.back());
    std::vector<std::uint32_t> next(visits.start.begin(), visits.start.end() - 1);
    for (std::size_t line = 0; line < lines; ++line) {
        LineVisit* first = nullptr;
        LineVisit* last = nullptr;
        std::uint32_t first_vertex = kNoVertex;
        std::uint32_t last_vertex = kNoVertex;
        walk.for_each_stop(line, [&](const LineStop& stop) {
            LineVisit& visit = visits.all[next[stop.vertex]++];
            visit = {static_cast<std::uint32_t>(line), stop.point, kNoVertex, kNoVertex, stop.is_own};
            if (!stop.is_repeated) {
                visit.before = last_vertex;
                if (last != nullptr) {
                    last->after = stop.vertex;
                }
                first_vertex = first == nullptr ? stop.vertex : first_vertex;
                first = first == nullptr ? &visit : first;
                last = &visit;
                last_vertex = stop.vertex;
            }
        });
        if (first != last && first_vertex == last_vertex) {  // closed: no end to be seen
            first->before = std::exchange(last->before, kNoVertex);
        }
    }
    return visits;
}

}  // namespace tinwright
