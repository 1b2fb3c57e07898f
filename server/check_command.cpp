#include "server/check_command.h"

#include <httplib.h>

#include <iostream>

namespace spherematch {

namespace {

constexpr int patience_seconds = 4;

/// A server that listens on every address listens on this machine's own.
std::string reachable(const std::string& host) {
  if (host == "0.0.0.0") return "127.0.0.1";
  return host == "::" ? "::1" : host;
}

}  // namespace

int check_command(const std::string& host, int port) {
  httplib::Client client(reachable(host), port);
  client.set_connection_timeout(patience_seconds);
  client.set_read_timeout(patience_seconds);
  const httplib::Result result = client.Get("/readyz");
  if (!result) {
    std::cerr << "no answer from " << reachable(host) << " port " << port << ": " << httplib::to_string(result.error()) << "\n";
    return 1;
  }
  std::cout << result->body;
  return result->status == 200 ? 0 : 1;
}

}  // namespace spherematch
