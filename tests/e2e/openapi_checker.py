"""Holds a running server against an OpenAPI document: parameters, methods, statuses, media types and schemas."""
import json
import re

import jsonschema

METHODS = ('get', 'post', 'put', 'patch', 'delete')


class Disagreement(AssertionError):
    pass


class Checker:
    """`request(method, target, body, headers)` gives an object with status, headers and body. Every response that passes through call()
    is held against the document."""

    def __init__(self, document, request):
        self.document, self.request = document, request
        self.seen = set()  # (method, path, status) of every response so far

    def resolve(self, value):
        while '$ref' in value:
            place = self.document
            for part in value['$ref'].removeprefix('#/').split('/'):
                place = place[part]
            value = place
        return value

    def operation(self, method, path):
        item = self.document['paths'].get(path, {})
        if method not in item:
            raise Disagreement(f'{method} {path} is not in the document')
        return item[method]

    def parameters(self, method, path):
        item = self.document['paths'][path]
        listed = item.get('parameters', []) + self.operation(method, path).get('parameters', [])
        return [self.resolve(parameter) for parameter in listed]

    def call(self, method, path, target=None, body=None, headers=None):
        response = self.request(method.upper(), target or path, body, headers or {})
        self.check(method, path, response)
        return response

    def check(self, method, path, response):
        where = f'{method} {path} {response.status}'
        responses = self.operation(method, path)['responses']
        if str(response.status) not in responses:
            raise Disagreement(f'{where}: the status is not in the document')
        self.seen.add((method, path, response.status))
        content = self.resolve(responses[str(response.status)]).get('content', {})
        if not content:
            if response.body:
                raise Disagreement(f'{where}: a body that is not in the document')
            return
        media_type = response.headers['Content-Type'].split(';')[0]
        if media_type not in content:
            raise Disagreement(f'{where}: {media_type} is not in the document')
        if media_type.endswith('ndjson'):
            values = [json.loads(line) for line in response.body.decode().splitlines()]
        elif media_type.endswith('json'):
            values = [json.loads(response.body)]
        else:
            return
        for value in values:
            self.validate(value, content[media_type]['schema'], where)

    def validate(self, value, schema, where):
        # The references in the schema point into the whole document.
        resolver = jsonschema.RefResolver('', self.document)
        errors = list(jsonschema.Draft202012Validator(schema, resolver=resolver).iter_errors(value))
        if errors:
            error = jsonschema.exceptions.best_match(errors)
            raise Disagreement(f'{where}: {error.json_path}: {error.message}')

    # What holds for every operation

    def check_references(self):
        def walk(value):
            if isinstance(value, dict):
                if '$ref' in value:
                    self.resolve(value)
                value = value.values()
            elif not isinstance(value, list):
                return
            for part in value:
                walk(part)
        walk(self.document)
        jsonschema.Draft202012Validator.check_schema(
            {'$defs': self.document['components']['schemas']})

    def check_methods(self, path, target):
        """The server names the methods of a path when it is asked for another."""
        response = self.request('PUT', target, None, {})
        if response.status != 405:
            raise Disagreement(f'{path}: PUT gave {response.status}')
        allowed = {method.strip().lower() for method in response.headers['Allow'].split(',')} - {'head'}
        documented = {method for method in METHODS if method in self.document['paths'][path]}
        if allowed != documented:
            raise Disagreement(f'{path}: has {sorted(allowed)}, the document {sorted(documented)}')

    def check_parameters(self, method, path, target, body):
        """The server names the parameters of an operation when it gets an unknown one."""
        response = self.request(method.upper(), target + '?no-such-parameter=1', body, {})
        detail = json.loads(response.body)['detail']
        if response.status != 400 or 'no-such-parameter' not in detail:
            raise Disagreement(f'{method} {path}: an unknown parameter gave {response.status}, {detail}')
        found = re.search(r'allowed are (.*)$', detail)
        allowed = set(found.group(1).split(', ')) if found else set()
        documented = {parameter['name'] for parameter in self.parameters(method, path) if parameter['in'] == 'query'}
        if allowed != documented:
            raise Disagreement(f'{method} {path}: takes {sorted(allowed)}, the document says {sorted(documented)}')

    def check_values(self, method, path, target, body, rest):
        """Every documented value of a parameter is taken, and another is refused, by name."""
        for parameter in self.parameters(method, path):
            values = parameter['schema'].get('enum')
            if parameter['in'] != 'query' or not values:
                continue
            bad = self.request(method.upper(), f'{target}?{parameter["name"]}=no-such-value&{rest}', body, {})
            detail = json.loads(bad.body)['detail']
            if bad.status != 400 or f'is not one of {", ".join(values)}' not in detail:
                raise Disagreement(f'{method} {path} {parameter["name"]}: {bad.status}, {detail}')
            if parameter['schema'].get('default', values[0]) not in values:
                raise Disagreement(f'{method} {path} {parameter["name"]}: its default is none of its values')
