// From what the store and the runner know of a shape to what the interface says of it.
#pragma once

#include <optional>

#include "api/types.h"
#include "server/job_runner.h"
#include "storage/shape_store.h"

namespace spherematch {

/// `job` is the preparation under way, asked for before the record was read.
[[nodiscard]] api::Shape shape_of(const ShapeRecord& record, const std::optional<JobStatus>& job);

}  // namespace spherematch
