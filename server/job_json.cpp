#include "server/job_json.h"

namespace spherematch {

namespace {

api::Job common(const JobRecord& record) {
  api::Job job;
  job.id = record.id;
  job.kind = to_string(record.kind);
  job.state = to_string(record.state);
  job.created_at = record.created_at;
  job.started_at = record.started_at;
  job.finished_at = record.finished_at;
  return job;
}

}  // namespace

api::Job job_of(const JobRecord& record, const std::optional<JobStatus>& status) {
  api::Job job = common(record);
  job.shape = record.shape;
  if (record.state == JobState::succeeded) job.progress = 1;
  if (record.state == JobState::failed) {
    job.error.emplace();
    job.error->code = api::code_from_wire(record.error_code).value_or(api::Code::internal);
    job.error->detail = record.error_detail;
    if (job.error->code == api::Code::cancelled) job.state = to_string(JobState::cancelled);
  }
  const bool active = record.state == JobState::queued || record.state == JobState::processing;
  if (active && status) {
    job.state = to_string(status->running ? JobState::processing : JobState::queued);
    job.stage = status->stage;
    job.progress = status->progress;
    job.position = static_cast<std::int32_t>(status->position);
  }
  return job;
}

api::Job job_of(const JobRecord& record, std::int32_t position) {
  api::Job job = common(record);
  job.pairs = api::PairCounts{record.pairs, record.finished_pairs - record.failed_pairs, record.failed_pairs};
  job.progress = static_cast<double>(record.finished_pairs) / record.pairs;
  if (record.state == JobState::queued) job.position = position;
  job.results = "/jobs/" + record.id + "/results";
  return job;
}

}  // namespace spherematch
