// Checks that several tests make of a repaired surface and of a refusal.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "engine/data/error.h"
#include "engine/data/surface.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch::test {

/// Fails the test unless `surface` fulfils the invariants that engine/data/surface.h promises for this upload, found out anew from
/// the face list: two opposite half-edges for each edge, one fan for each vertex, one component, Euler characteristic two,
/// positive volume, and every reference to the upload in its place, bit for bit.
void expect_invariants(const Surface& surface, const PolygonMesh& upload);

[[nodiscard]] double signed_volume(const TriMesh& mesh);
[[nodiscard]] double total_area(const TriMesh& mesh);

/// Runs `action` and returns what it threw; fails the test unless that is an EngineError with this code.
OffendingElements expect_refusal(ErrorCode code, const std::function<void()>& action);

}  // namespace spherematch::test
