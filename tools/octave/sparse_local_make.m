function sparse_local_make(folder, varargin)
%SPARSE_LOCAL_MAKE  Compiles sparse_local_mex for Octave (mkoctfile) or MATLAB (mex).
%
%   sparse_local_make             beside this file; takes half a minute
%   sparse_local_make(folder, flag, ...)   in another folder, with flags of the compiler
%
%   It needs a C compiler and sparse_local.h, beside this file or two folders above it. Then add
%   this folder to the path: addpath('.../tools/octave').

    here = fileparts(mfilename('fullpath'));
    if nargin < 1, folder = here; end
    header = here;
    if ~exist(fullfile(here, 'sparse_local.h'), 'file'), header = fullfile(here, '..', '..'); end
    source = fullfile(here, 'sparse_local_mex.c');
    flags = [{['-I', header]}, varargin];
    if exist('OCTAVE_VERSION', 'builtin')
        target = fullfile(folder, 'sparse_local_mex');
        [~, status] = mkoctfile('--mex', flags{:}, '-o', target, source);
        if status ~= 0, error('sparse_local:make', 'the compiler fails, for the reasons above'); end
    else
        mex(flags{:}, '-outdir', folder, source);
    end
end
