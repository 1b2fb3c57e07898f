#include "server/shape_json.h"

namespace spherematch {

namespace {

api::Repair repair_of(const ShapeRecord& record) {
  const RepairReport& report = record.repair;
  return {.mode = record.options.starts_with("repair=none") ? "none" : "fill",
          .filled_loops = report.filled_loops,
          .added_vertices = report.added_vertices,
          .added_faces = report.added_faces,
          .dropped_vertices = report.dropped_vertices,
          .welded_vertices = report.welded_vertices,
          .split_vertices = report.split_vertices,
          .flipped_faces = report.flipped_faces,
          .removed_faces = report.removed_faces,
          .dropped_components = report.dropped_components};
}

api::Problem stored_problem(const ShapeRecord& record) {
  api::Problem problem;
  problem.code = api::code_from_wire(record.error_code).value_or(api::Code::internal);
  problem.detail = record.error_detail;
  return problem;
}

api::ShapeState state_of(ShapeState state) {
  switch (state) {
    case ShapeState::queued:
      return api::ShapeState::queued;
    case ShapeState::processing:
      return api::ShapeState::processing;
    case ShapeState::ready:
      return api::ShapeState::ready;
    case ShapeState::failed:
      return api::ShapeState::failed;
  }
  return api::ShapeState::failed;
}

}  // namespace

api::Shape shape_of(const ShapeRecord& record, const std::optional<JobStatus>& job) {
  api::Shape shape;
  shape.id = record.id;
  shape.name = record.name;
  shape.tags = record.tags;
  shape.state = state_of(record.state);
  shape.vertices = record.vertices;
  shape.faces = record.faces;
  shape.sha256 = record.sha256;
  shape.repair = repair_of(record);
  shape.simplified = record.simplified;
  shape.created_at = record.created_at;
  if (record.state == ShapeState::ready) {
    shape.progress = 1;
    shape.seconds = record.seconds;
    shape.engine = record.engine;
    if (record.sphere) {
      shape.sphere = api::Sphere{record.sphere->flipped, record.sphere->solid_angle_defect, record.sphere->area_distortion};
    }
  } else if (record.state == ShapeState::failed) {
    shape.error = stored_problem(record);
  } else if (job) {
    shape.state = job->running ? api::ShapeState::processing : api::ShapeState::queued;
    shape.stage = job->stage;
    shape.progress = job->progress;
  }
  return shape;
}

}  // namespace spherematch
