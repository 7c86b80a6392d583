# One image for the web process, for workers and for the command; docs/service.md says how to run it.

FROM node:22-bookworm-slim AS viewer
WORKDIR /source
COPY templates/viewer templates/viewer
RUN templates/viewer/build

FROM python:3.11-slim-bookworm AS build
WORKDIR /source
COPY constraints.txt ./
RUN pip install --no-cache-dir -c constraints.txt build hatchling
COPY pyproject.toml README.md LICENSE NOTICE ./
COPY scripts scripts
COPY checker checker
COPY rules rules
COPY samples samples
COPY templates templates
COPY --from=viewer /source/templates/report/viewer.js templates/report/
RUN python -m build --wheel --no-isolation \
 && python -m venv --without-pip /opt/subt-check \
 && pip --python /opt/subt-check/bin/python install --no-cache-dir -c constraints.txt \
    "$(echo dist/*.whl)[all]"

FROM python:3.11-slim-bookworm
# What Pinocchio runs on, and what draws a report's pictures. The distribution mends them under the
# same name: hence no versions.
# hadolint ignore=DL3008
RUN apt-get update \
 && apt-get install -y --no-install-recommends libgomp1 libegl1 libopengl0 libgl1-mesa-dri \
 && rm -rf /var/lib/apt/lists/* \
 && install -d -m 0700 -o 10001 -g 10001 /data
COPY --from=build /opt/subt-check /opt/subt-check
# /data and /tmp are all that has to be writable.
ENV PATH=/opt/subt-check/bin:$PATH \
    PYTHONUNBUFFERED=1 \
    HOME=/tmp \
    SUBT_CHECK_DATA=/data \
    SUBT_CHECK_CACHE=/tmp/cache
# A user without a name; its number is fixed, so that volumes keep their owner.
USER 10001:10001
WORKDIR /data
VOLUME /data
EXPOSE 8000
HEALTHCHECK --interval=30s --timeout=10s --start-period=30s CMD ["python", "-c", \
    "from http.client import HTTPConnection; c = HTTPConnection('127.0.0.1', 8000, timeout=5); c.request('GET', '/healthz'); exit(c.getresponse().status != 200)"]
ENTRYPOINT ["subt-check"]
CMD ["serve", "--host", "0.0.0.0", "--port", "8000"]
