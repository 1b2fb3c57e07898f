// From what the store and the runners know of a job to what the interface says of it.
#pragma once

#include <cstdint>
#include <optional>

#include "api/types.h"
#include "server/job_runner.h"
#include "storage/job_store.h"

namespace spherematch {

/// A preparation; `status` where it is under way.
[[nodiscard]] api::Job job_of(const JobRecord& record, const std::optional<JobStatus>& status);

/// A match job with so many others in front of it.
[[nodiscard]] api::Job job_of(const JobRecord& record, std::int32_t position);

}  // namespace spherematch
