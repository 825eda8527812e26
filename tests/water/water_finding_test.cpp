#include "tinwright/water/water_finding.hpp"

#include <vector>

#include <doctest/doctest.h>

using tinwright::WaterFinding;

TEST_SUITE("water/water_finding") {
    TEST_CASE("findings are counted by kind") {
        std::vector<WaterFinding> findings(3);
        findings[1].kind = WaterFinding::Kind::Braid;
        const auto counts = tinwright::count_findings(findings);
        CHECK(counts[static_cast<std::size_t>(WaterFinding::Kind::RunsUphill)] == 2);
        CHECK(counts[static_cast<std::size_t>(WaterFinding::Kind::Braid)] == 1);
    }

    TEST_CASE("what water may do is no fault") {
        WaterFinding finding;
        CHECK(tinwright::is_fault(finding));
        finding.kind = WaterFinding::Kind::Braid;
        CHECK_FALSE(tinwright::is_fault(finding));
        finding.kind = WaterFinding::Kind::LakesMeet;
        CHECK_FALSE(tinwright::is_fault(finding));
        finding.amount = 0.5;
        CHECK(tinwright::is_fault(finding));
    }
}
