#!/usr/bin/env bash
# Certifies an engine in continuous integration; action.yml and the GitLab template call it. It installs contact-oracle where it is not there,
# judges, leaves the reports in a folder and ends with the exit status of `contact-oracle certify`, or of `properties` where that is worse.
#
# All comes from the environment; what is empty is as good as absent:
#   CONTACT_ENGINE_COMMAND, CONTACT_ENGINE_LIBRARY, CONTACT_RESULTS    the engine: one of the three
#   CONTACT_DATASETS    files and folders, one a line; the golden files of the program if there are none
#   CONTACT_FAMILY, CONTACT_LEVEL, CONTACT_TOLERANCE, CONTACT_PROFILE, CONTACT_BASELINE    the options of certify
#   CONTACT_FRESH       how many fresh questions of each family; 0 for none
#   CONTACT_SEED        the seed of fresh questions and of laws; 42 if empty, so that a build does not become red by chance. With CONTACT_BASELINE the
#                       fresh questions are those that it was made with, and CONTACT_RESULTS has no answers to any
#   CONTACT_ARGUMENTS   more words for certify, one a line
#   CONTACT_LAWS        how many questions for each law; none if empty
#   CONTACT_REPORTS     the folder of the reports (contact-oracle-reports)
#   CONTACT_PACKAGE     a Debian package, a file or an address; without it that of CONTACT_VERSION among the releases of CONTACT_REPOSITORY
#   CONTACT_SHA256      the package's digest, which is then compared
set -euo pipefail

refuse() {
  echo "contact-oracle: $*" >&2
  exit 2
}

# The address of the package of a release. An action's folder is .../_actions/OWNER/NAME/REF, and the version is that of the files in it.
address() {
  local repository=${CONTACT_REPOSITORY:-} version=${CONTACT_VERSION:-} source
  if [ -z "$repository" ] && [[ ${GITHUB_ACTION_PATH:-} =~ /_actions/([^/]+/[^/]+)/ ]]; then
    repository=${BASH_REMATCH[1]}
  fi
  source=$(dirname "${BASH_SOURCE[0]}")/../../CMakeLists.txt
  if [ -z "$version" ] && [ -f "$source" ]; then
    version=$(sed -n 's/^project(contact-oracle VERSION \([0-9.]*\).*/\1/p' "$source")
  fi
  if [ -z "$repository" ] || [ -z "$version" ]; then
    refuse "nothing says which package to install: give package, or repository and version"
  fi
  echo "${GITHUB_SERVER_URL:-https://github.com}/$repository/releases/download/v$version/contact-oracle_${version}-1_$(dpkg --print-architecture).deb"
}

install_program() {
  local package=$1 sudo=() digest
  command -v apt-get >/dev/null || refuse "the package is for Debian 12, and here is no apt-get: run the job in the container debian:12"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || refuse "neither root nor sudo is at hand to install $package"
    sudo=(sudo)
  fi
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
  "${sudo[@]}" apt-get update -qq
  if [ -f "$package" ]; then
    cp "$package" "$folder/contact-oracle.deb"
  else
    command -v curl >/dev/null || "${sudo[@]}" apt-get install -qq -y --no-install-recommends ca-certificates curl >&2
    curl -fsSL --retry 3 -o "$folder/contact-oracle.deb" "$package" || refuse "could not load $package"
  fi
  digest=$(sha256sum "$folder/contact-oracle.deb")
  digest=${digest%% *}
  if [ -n "${CONTACT_SHA256:-}" ] && [ "$digest" != "$CONTACT_SHA256" ]; then
    refuse "$package has the SHA-256 $digest, not $CONTACT_SHA256"
  fi
  chmod 755 "$folder"  # apt reads it as a user of its own
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "$folder/contact-oracle.deb" >&2 ||
    refuse "could not install $package, which is for Debian 12: run the job in the container debian:12, or give another package"
}

engine=()
options=()
datasets=()
arguments=()
# one LIST OPTION VALUE: the option with its value, which is one word whatever it is.
one() {
  local -n list=$1
  [ -z "$3" ] || list+=("$2" "$3")
}
one engine --engine-command "${CONTACT_ENGINE_COMMAND:-}"
one engine --engine-library "${CONTACT_ENGINE_LIBRARY:-}"
one engine --results "${CONTACT_RESULTS:-}"
[ ${#engine[@]} -eq 2 ] || refuse "name one engine: engine-command, engine-library or results"
reports=${CONTACT_REPORTS:-contact-oracle-reports}
[[ $reports != *$'\n'* ]] || refuse "reports: the name of a folder here has no line feed, which would be another output of the job"
one options --family "${CONTACT_FAMILY:-}"
one options --level "${CONTACT_LEVEL:-}"
one options --tolerance "${CONTACT_TOLERANCE:-}"
one options --profile "${CONTACT_PROFILE:-}"
one options --baseline "${CONTACT_BASELINE:-}"
while read -r line; do [ -z "$line" ] || datasets+=("$line"); done <<<"${CONTACT_DATASETS:-}"
while read -r line; do [ -z "$line" ] || arguments+=("$line"); done <<<"${CONTACT_ARGUMENTS:-}"
seed=${CONTACT_SEED:-}
chosen='^--(seed|fresh|generate|failures-of)(=.*)?$'
for word in "${arguments[@]}"; do [[ ! $word =~ $chosen ]] || seed=none; done
if [ -z "$seed" ] && [ -z "${CONTACT_RESULTS:-}${CONTACT_BASELINE:-}" ] && [ "${CONTACT_FRESH:-}" != 0 ]; then seed=42; fi
one options --fresh "${CONTACT_FRESH:-}"
[ "$seed" = none ] || one options --seed "$seed"

if [ -n "${CONTACT_PACKAGE:-}" ] || ! command -v contact-oracle >/dev/null; then
  package=${CONTACT_PACKAGE:-$(address)}
  install_program "$package"
fi

mkdir -p "$reports"
rm -f "$reports"/contacts.{html,xml,md,json} "$reports/laws.xml"
status=0
contact-oracle certify "${datasets[@]}" "${engine[@]}" "${options[@]}" --report "$reports/contacts.html" --junit "$reports/contacts.xml" \
  --markdown "$reports/contacts.md" --json "$reports/contacts.json" "${arguments[@]}" || status=$?
if [ -n "${CONTACT_LAWS:-}" ]; then
  contact-oracle properties "${engine[@]}" --cases "$CONTACT_LAWS" --seed "${CONTACT_SEED:-42}" --junit "$reports/laws.xml" || status=$(($? > status ? $? : status))
fi
if [ -n "${GITHUB_STEP_SUMMARY:-}" ]; then
  if [ -f "$reports/contacts.md" ]; then
    cat "$reports/contacts.md" >>"$GITHUB_STEP_SUMMARY"
  else
    echo "contact-oracle judged nothing: exit status $status. The log says why." >>"$GITHUB_STEP_SUMMARY"
  fi
fi
[ -z "${GITHUB_OUTPUT:-}" ] || printf 'status=%s\nreports=%s\n' "$status" "$reports" >>"$GITHUB_OUTPUT"
exit "$status"
