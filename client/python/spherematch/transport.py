# SPDX-License-Identifier: MIT
"""Requests with timeouts and retries."""
import http.client
import json
import ssl
import time
import urllib.parse

from .errors import ProblemError, TransportError

_PASSES = {429, 502, 503, 504}  # the same request may succeed later


class Transport:
    def __init__(self, url, api_key, timeout, retries):
        parts = urllib.parse.urlsplit(url if '//' in url else 'http://' + url)
        if parts.scheme not in ('http', 'https') or not parts.hostname:
            raise ValueError(f'{url!r} is not an http or https address')
        self._secure = parts.scheme == 'https'
        self._host, self._port = parts.hostname, parts.port
        self._prefix = parts.path.rstrip('/')
        self._headers = {'Authorization': 'Bearer ' + api_key} if api_key else {}
        self._timeout, self._retries = timeout, retries

    def request(self, method, path, query=None, body=None, headers=None, extra_time=0.0, idempotent=True):
        """The response's status, headers and body. A refusal that passes is tried again, and a lost connection where the request can
        be repeated without harm."""
        for attempt in range(self._retries + 1):
            last = attempt == self._retries
            try:
                with self.open(method, path, query, body, headers, extra_time) as response:
                    return response.status, response.headers, response.read()
            except ProblemError as error:
                if last or error.status not in _PASSES:
                    raise
                pause = error.retry_after or 0.2 * 2 ** attempt
            except TransportError:
                if last or not idempotent:
                    raise
                pause = 0.2 * 2 ** attempt
            time.sleep(min(pause, 30))

    def json(self, method, path, query=None, body=None, **options):
        if body is not None:
            body = json.dumps(body).encode()
        return json.loads(self.request(method, path, query, body, {'Accept': 'application/json'}, **options)[2])

    def json_of_upload(self, query, data):
        return json.loads(self.request('POST', '/shapes', query, data, {'Accept': 'application/json'}, extra_time=query['wait'])[2])

    def open(self, method, path, query=None, body=None, headers=None, extra_time=0.0):
        """The response, to be read by the caller; closes its connection. Raises ProblemError for a refusal."""
        query = {name: value for name, value in (query or {}).items() if value is not None}
        target = self._prefix + path + ('?' + urllib.parse.urlencode(query) if query else '')
        timeout = self._timeout + extra_time
        if self._secure:
            connection = http.client.HTTPSConnection(self._host, self._port, timeout=timeout, context=ssl.create_default_context())
        else:
            connection = http.client.HTTPConnection(self._host, self._port, timeout=timeout)
        try:
            connection.request(method, target, body=body, headers={**self._headers, **(headers or {})})
            response = connection.getresponse()
            if response.status >= 400:
                raise _problem(response)
            return _Closing(response, connection)
        except (OSError, http.client.HTTPException) as error:
            connection.close()
            raise TransportError(f'{method} {path}: {error or type(error).__name__}') from error
        except BaseException:
            connection.close()
            raise


class _Closing:
    """A response that takes its connection along, and whose reading raises what this package documents."""

    def __init__(self, response, connection):
        self.status, self.headers = response.status, response.headers
        self._response, self._connection = response, connection

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._connection.close()

    def read(self):
        return self._guard(self._response.read)

    def lines(self):
        while line := self._guard(self._response.readline):
            yield line

    @staticmethod
    def _guard(read):
        try:
            return read()
        except (OSError, http.client.HTTPException) as error:
            raise TransportError(f'the answer broke off: {error or type(error).__name__}') from error


def _problem(response):
    text = response.read()
    try:
        problem = json.loads(text)
    except ValueError:
        problem = {'status': response.status, 'detail': text[:200].decode('utf-8', 'replace')}
    retry_after = response.headers.get('Retry-After')
    return ProblemError(response.status, problem, float(retry_after) if retry_after and retry_after.isdigit() else None)
