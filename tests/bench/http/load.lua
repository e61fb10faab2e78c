-- SPDX-License-Identifier: GPL-3.0-or-later
-- Requests for wrk. Arguments: MODE, PATH, BODY (JSON; %d in it is a number that no request had before).
--   get PATH?QUERY    post PATH BODY    mixed PATH BODY COLD_BODY: one in 50 is new
--   cold PATH BODY DELAY_MS: each connection waits so long before it asks again
local mode, path, body, cold
local count, base = 0, 0
local headers = {["Content-Type"] = "application/json"}

function init(args)
  mode, path, body, cold = args[1], args[2], args[3], args[4]
  if mode == "cold" and cold then
    -- defined only here: wrk would use a timer for every request
    function delay() return tonumber(cold) end
  end
  base = os.time() % 1000000 * 1000000
end

local prepared
function request()
  count = count + 1
  if mode == "cold" then
    return wrk.format("POST", path, headers, string.format(body, (base + count) % 1000000000))
  end
  if mode == "mixed" and count % 50 == 0 then
    return wrk.format("POST", path, headers, string.format(cold, (base + count) % 1000000000))
  end
  if not prepared then
    prepared = mode == "get" and wrk.format("GET", path) or wrk.format("POST", path, headers, body)
  end
  return prepared
end

function done(summary, latency)
  local e = summary.errors
  io.write(string.format('{"requests": %d, "us": %d, "errors": %d, "p50_us": %d, "p99_us": %d}\n', summary.requests,
    summary.duration, e.connect + e.read + e.write + e.status + e.timeout, latency:percentile(50),
    latency:percentile(99)))
end
