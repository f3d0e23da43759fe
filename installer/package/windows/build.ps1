# Run on Windows 10 or 11, once per release:  powershell -ExecutionPolicy Bypass -File installer\package\windows\build.ps1
# Needs Python 3.11 to 3.13 (64 bit) and NSIS 3 (makensis on the path or in its usual folder). Writes dist\Carpus-VERSION-setup.exe.
$ErrorActionPreference = "Stop"
$root = Resolve-Path "$PSScriptRoot\..\..\.."
Set-Location $root
$makensis = (Get-Command makensis -ErrorAction SilentlyContinue).Source
if (-not $makensis) { $makensis = "${env:ProgramFiles(x86)}\NSIS\makensis.exe" }
if (-not (Test-Path $makensis)) { throw "NSIS 3 is missing." }
py -3 installer\package\build.py --keep-folder
if ($LASTEXITCODE) { throw "The packing failed." }
py -3 installer\package\windows\setup_program.py build\package\carpus --makensis $makensis
if ($LASTEXITCODE) { throw "The installer failed." }
# With a signing certificate at hand: signtool sign /fd SHA256 /tr <time stamp server> dist\Carpus-*-setup.exe
